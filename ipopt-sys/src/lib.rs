//! Raw bindings of Ipopt's C interface.
