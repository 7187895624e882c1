//! Direct multiple shooting.
