//! What can be wrong with a function's definition.

use thiserror::Error;

/// Why [`FunctionBuilder::build`](super::FunctionBuilder::build) refused.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum FunctionError {
    /// Two inputs, or two outputs, have one name.
    #[error("function {function}: there are two ports called {port}")]
    DuplicatePort {
        /// The function's name.
        function: String,
        /// The name used twice.
        port: String,
    },
    /// An input element is not a symbol.
    #[error("function {function}: element {index} of input {port} is not a symbol")]
    InputNotSymbol {
        /// The function's name.
        function: String,
        /// The input's name.
        port: String,
        /// Which element.
        index: usize,
    },
    /// One symbol stands at two places among the inputs.
    #[error(
        "function {function}: element {index} of input {port} is the symbol {symbol}, \
         which is an input already"
    )]
    DuplicateInput {
        /// The function's name.
        function: String,
        /// The input's name.
        port: String,
        /// Which element.
        index: usize,
        /// The symbol's name.
        symbol: String,
    },
    /// The outputs depend on symbols that are no inputs.
    #[error("function {function}: the outputs depend on {}, which no input provides",
            symbols.join(", "))]
    FreeSymbols {
        /// The function's name.
        function: String,
        /// The symbols' names.
        symbols: Vec<String>,
    },
}
