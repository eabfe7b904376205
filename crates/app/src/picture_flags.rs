//! What is asked of the pictures of a command.

use topple::scene::LONGEST_TITLE;
use topple_manifest::Pictures;
use topple_pictures::colours::print_palette::Palette;
use topple_pictures::drawing::print::{Print, PrintError};

use super::numbers::number;
use super::written::one_of;

/// The heading of the flags: each has it of its own, so that what follows them does not.
const HEADING: &str = "Pictures";

/// How pictures are printed.
#[derive(Debug, Clone, clap::Args)]
pub struct PictureFlags {
    /// Title of the pictures, and of the run in a report; if there are several pictures, what each shows follows the title
    #[arg(long, value_name = "TEXT", help_heading = HEADING, value_parser = title)]
    title: Option<String>,
    /// Width of the pictures in print, 40 to 600 mm [default: 90; of a comparison 140]
    #[arg(long, value_name = "MM", help_heading = HEADING, value_parser = number, allow_negative_numbers = true)]
    width: Option<f64>,
    /// Font size of the pictures, 4 to 40 points; lines and marks scale with it [default: 7]
    #[arg(long, value_name = "PT", help_heading = HEADING, value_parser = number, allow_negative_numbers = true)]
    font_size: Option<f64>,
    /// Colours of the pictures [default: colour]
    #[arg(long, value_name = "NAME", help_heading = HEADING, value_parser = one_of::<Palette>())]
    palette: Option<Palette>,
}

impl PictureFlags {
    /// Their names, for messages.
    pub const NAMES: &str = "--title, --width, --font-size, --palette";

    /// What run.json says of them.
    pub fn record(&self) -> Pictures {
        Pictures {
            title: self.title.clone(),
            width: self.width,
            font_size: self.font_size,
            palette: self.palette,
        }
    }

    /// How pictures are printed.
    ///
    /// # Errors
    /// A width or a size out of bounds, or letters too large for the width.
    pub fn print(&self) -> Result<Print<'_>, String> {
        let mut print = Print::new(self.width, self.font_size).map_err(|error| match error {
            PrintError::Width(_) => format!("--width: {error}; give it in mm"),
            PrintError::FontSize(_) => format!("--font-size: {error}; give it in points"),
            PrintError::Narrow { .. } if self.width.is_some() => {
                format!("--width: {error}; give a larger one or a smaller --font-size")
            }
            PrintError::Narrow { .. } => {
                format!("--font-size: {error}; give a smaller one or a larger --width")
            }
        })?;
        print.title = self.title.as_deref();
        print.palette = self.palette.unwrap_or_default();
        Ok(print)
    }

    /// Takes over what an earlier run asked for, where no flag says otherwise.
    pub fn adopt(&mut self, earlier: Pictures) {
        self.title = self.title.take().or(earlier.title);
        self.width = self.width.or(earlier.width);
        self.font_size = self.font_size.or(earlier.font_size);
        self.palette = self.palette.or(earlier.palette);
    }
}

/// A title: a line that says something.
pub fn title(text: &str) -> Result<String, String> {
    let is_line = !text.trim().is_empty() && !text.contains(char::is_control);
    match text.chars().nth(LONGEST_TITLE) {
        Some(_) => Err(format!("must have {LONGEST_TITLE} letters at most")),
        None if is_line => Ok(text.to_string()),
        None => Err("must be one line of text".into()),
    }
}
