//! Safe Ipopt.
