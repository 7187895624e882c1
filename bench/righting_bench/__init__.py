"""CasADi reference solutions of Righting's scenarios, and the speed comparison with them."""

from . import threads  # noqa: F401  set before any library starts its pool
