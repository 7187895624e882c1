/// A table of C functions: each a field, a function pointer of its name.
///
/// Those after `optional` are missing from some versions of the library. In a program that links
/// the library the others are ordinary foreign functions too.
macro_rules! functions {
    (
        $(#[$about:meta])*
        pub struct $table:ident;
        $(
            $(#[$doc:meta])*
            fn $name:ident($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)?;
        )*
        $(
            optional
            $(
                $(#[$optional_doc:meta])*
                fn $optional:ident($($optional_argument:ident: $optional_type:ty),* $(,)?)
                    $(-> $optional_result:ty)?;
            )*
        )?
    ) => {
        #[cfg(not(feature = "dlopen"))]
        unsafe extern "C" {
            $($(#[$doc])* pub fn $name($($argument: $type),*) $(-> $result)?;)*
        }

        $(#[$about])*
        #[derive(Debug, Clone, Copy)]
        pub struct $table {
            $(
                $(#[$doc])*
                pub $name: unsafe extern "C" fn($($argument: $type),*) $(-> $result)?,
            )*
            $($(
                $(#[$optional_doc])*
                pub $optional: Option<
                    unsafe extern "C" fn($($optional_argument: $optional_type),*)
                        $(-> $optional_result)?
                >,
            )*)?
        }

        impl $table {
            /// # Safety
            /// The library's functions of these names must have these types.
            // Where the library is linked and nothing optional, neither is needed.
            #[cfg_attr(not(feature = "dlopen"), allow(unused_unsafe, unused_variables))]
            unsafe fn resolve(
                library: &'static $crate::library::Library,
            ) -> Result<Self, $crate::library::LoadError> {
                // SAFETY: the caller's promise.
                unsafe {
                    Ok(Self {
                        $(
                            #[cfg(feature = "dlopen")]
                            $name: library.function(stringify!($name))?,
                            #[cfg(not(feature = "dlopen"))]
                            $name,
                        )*
                        $($($optional: library.optional_function(stringify!($optional)),)*)?
                    })
                }
            }
        }
    };
}

pub(crate) use functions;
