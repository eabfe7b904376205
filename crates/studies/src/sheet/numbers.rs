//! Numbers of a table: which of the two signs, comma and point, is the decimal one.

use super::rows::Rows;
use topple::scene::shown::shown;

/// The signs that are decimal ones where exactly three digits follow them: elsewhere such a number may have a separator of thousands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decimals {
    comma: bool,
    point: bool,
}

impl Decimals {
    /// Those of a table. Where commas or blanks separate its cells, the point is the decimal sign. Where semicolons or tabs do, the
    /// numbers of the table tell it that have no three digits behind their sign.
    /// Columns of words, by their places, tell nothing: a device may be called `2.1`.
    pub fn of(rows: &Rows, is_words: impl Fn(usize) -> bool) -> Decimals {
        if ![';', '\t'].contains(&rows.separator()) {
            return Decimals { comma: false, point: true };
        }
        let (mut comma, mut point) = (false, false);
        for row in rows.clone().map_while(Result::ok) {
            for (at, cell) in row.cells.iter().enumerate() {
                match sign(cell).filter(|_| !is_words(at)) {
                    Some((',', false)) => comma = true,
                    Some(('.', false)) => point = true,
                    _ => {}
                }
            }
        }
        Decimals { comma: comma && !point, point: point && !comma }
    }

    /// A number; the error of one that may be either of two numbers, and of a text that is none.
    pub fn number(self, text: &str) -> Result<f64, String> {
        let is_decimal = |sign| if sign == ',' { self.comma } else { self.point };
        let none = || {
            format!(
                "'{}' is no number such as 0.0004 or 4e-4; give it without its unit",
                shown(text)
            )
        };
        match sign(text) {
            Some((sign, true)) if !is_decimal(sign) => {
                let thousands = text.replace(sign, "");
                let [whole, part] =
                    [thousands.parse(), text.replace(sign, ".").parse()].map(Result::<f64, _>::ok);
                let (Some(whole), Some(part)) = (whole, part) else { return Err(none()) };
                Err(format!("'{text}' may be {whole} or {part}; write the one that is meant"))
            }
            Some((',', _)) => text.replace(',', ".").parse().map_err(|_| none()),
            _ => text.parse().map_err(|_| none()),
        }
    }
}

/// True of a number, also of one that may be either of two.
pub fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok() || sign(text).is_some()
}

/// The one comma or point of a number, and true where it may separate thousands: one to three digits before it of which the first is no
/// zero, exactly three behind it, and no exponent.
fn sign(text: &str) -> Option<(char, bool)> {
    let bare = text.strip_prefix(['+', '-']).unwrap_or(text);
    let (whole, rest) = bare.split_at(bare.find([',', '.'])?);
    let sign = rest.chars().next()?;
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let (part, exponent) = rest[1..].split_at(digits(&rest[1..]));
    let power = exponent.strip_prefix(['e', 'E']);
    let is_number = digits(whole) == whole.len()
        && !(whole.is_empty() && part.is_empty())
        && (exponent.is_empty() || power.is_some_and(|power| power.parse::<i32>().is_ok()));
    let thousands = exponent.is_empty()
        && part.len() == 3
        && (1..=3).contains(&whole.len())
        && !whole.starts_with('0');
    is_number.then_some((sign, thousands))
}
