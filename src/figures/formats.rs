//! `--png`, of every command that draws.

use clap::Args;
use righting_report::FigureWriter;

use crate::failure::Failure;

/// What figures are written as.
#[derive(Args)]
pub struct Formats {
    /// Write every figure as PNG too, 192 pixels to the inch.
    #[arg(long)]
    pub png: bool,
}

impl Formats {
    /// What writes them. To be called before minutes are spent on what they show.
    pub fn writer(&self) -> Result<FigureWriter, Failure> {
        Ok(if self.png { FigureWriter::svg_and_png()? } else { FigureWriter::svg() })
    }
}
