//! `righting completions`: what a shell needs to complete the command line.

use clap::{Args, Command, CommandFactory};
use clap_complete::{Generator, Shell};

use crate::failure::Failure;
use crate::output;

/// Print the script with which a shell completes this program's commands and options.
///
/// Bash: source <(righting completions bash), in ~/.bashrc.
///
/// Zsh: righting completions zsh > _righting, in a folder of $fpath.
///
/// Fish: righting completions fish > ~/.config/fish/completions/righting.fish.
#[derive(Args)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut command = visible();
    command.set_bin_name(crate::NAME);
    command.build();
    let mut script = Vec::new();
    arguments.shell.try_generate(&command, &mut script).map_err(Failure::Stdout)?;
    output::print(&String::from_utf8_lossy(&script))
}

/// The command line without what is not for people: the generators offer hidden commands too.
fn visible() -> Command {
    let whole = crate::Arguments::command();
    let shown = whole.get_subcommands().filter(|command| !command.is_hide_set());
    Command::new(crate::NAME).version(crate::build::VERSION).subcommands(shown.cloned())
}
