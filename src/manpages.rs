//! `righting manpages`: the help of every command as manual pages.

mod markdown;

use std::io;
use std::path::PathBuf;

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};

use crate::failure::Failure;
use crate::output;
use crate::output_folder::OutputFolder;

/// Write the manual pages of this program and its commands: righting.1, righting-solve.1 and so on.
#[derive(Args)]
pub struct Arguments {
    /// The folder for the pages, such as ~/.local/share/man/man1; made if missing.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Write one page of Markdown instead, commands.md.
    #[arg(long)]
    markdown: bool,
}

/// The page of Markdown.
const MARKDOWN_FILE: &str = "commands.md";

/// Writes the pages and lists them.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = OutputFolder::open(&arguments.folder)?;
    let mut whole = crate::Arguments::command().disable_help_subcommand(true);
    whole.build();
    let mut files = Vec::new();
    match arguments.markdown {
        true => files.push(folder.write(MARKDOWN_FILE, markdown::page(&whole).as_bytes())?),
        false => write(&whole, &folder, &mut files)?,
    }
    let listed: String = files.iter().map(|file| format!("{}\n", file.display())).collect();
    output::print(&listed)
}

/// The page of a command, and those of the commands in it.
fn write(
    command: &Command,
    folder: &OutputFolder,
    files: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    let source = format!("{} {}", crate::NAME, env!("CARGO_PKG_VERSION"));
    let page = Man::new(command.clone()).source(source);
    let name = page.get_filename();
    let mut text = Vec::new();
    print(&page, command, &mut text).map_err(|source| righting_scenario::Error::Write {
        file: folder.path().join(&name),
        source,
    })?;
    files.push(folder.write(&name, &text)?);
    for part in command.get_subcommands().filter(|part| !part.is_hide_set()) {
        write(part, folder, files)?;
    }
    Ok(())
}

/// The sections of a page, in the order of manual pages; every command has the same exit codes.
fn print(page: &Man, command: &Command, text: &mut Vec<u8>) -> io::Result<()> {
    page.render_title(text)?;
    page.render_name_section(text)?;
    page.render_synopsis_section(text)?;
    page.render_description_section(text)?;
    page.render_options_section(text)?;
    if command.has_subcommands() {
        page.render_subcommands_section(text)?;
    }
    let mut status = Roff::new();
    status.control("SH", ["EXIT STATUS"]);
    for (code, meaning) in crate::EXIT_CODES {
        status.control("TP", []);
        status.text([roman(code.to_string())]);
        status.text([roman(meaning)]);
    }
    status.to_writer(text)
}
