//! Free-floating base and chain of revolute joints.
