//! Slews and detumbles of free-floating spacecraft.
