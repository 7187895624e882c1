//! Whether the Ipopt that was found calls linear solvers through hooks that a program may set.

fn main() {
    println!("cargo:rustc-check-cfg=cfg(ipopt_ma57_slot)");
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var_os("DEP_IPOPT_MA57_SLOT").is_some() {
        println!("cargo:rustc-cfg=ipopt_ma57_slot");
    }
}
