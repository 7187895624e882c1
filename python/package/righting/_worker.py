"""A worker process of a sweep: ``python -m righting._worker``."""

from righting._righting import serve_sweep

if __name__ == "__main__":
    serve_sweep()
