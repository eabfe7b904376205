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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(table: &str, text: &str) -> Result<f64, String> {
        Decimals::of(&Rows::of(table, 1, true).unwrap(), |_| false).number(text)
    }

    #[test]
    fn a_number_that_may_be_another_one_is_none() {
        let (commas, semicolons, tabs, blanks) = ("a,b\n", "a;b\n", "a\tb\n", "1 2\n");
        let (decimal_commas, decimal_points) = ("a;b\n0,25;1\n", "a;b\n0.25;1\n");
        let (tabs_commas, tabs_points) = ("a\tb\n1,5\t1\n", "a\tb\n1.5\t1\n");
        let both = "a;b\n0.25;0,25\n";
        for (table, comma, point) in [
            (commas, None, Some(1.25)),
            (blanks, None, Some(1.25)),
            (semicolons, None, None),
            (decimal_commas, Some(1.25), None),
            (decimal_points, None, Some(1.25)),
            (tabs, None, None),
            (tabs_commas, Some(1.25), None),
            (tabs_points, None, Some(1.25)),
            (both, None, None),
        ] {
            for (text, wanted) in
                [("1,250", comma), ("1.250", point), ("-1,250", comma.map(|n| -n))]
            {
                let found = of(table, text);
                assert_eq!(found.clone().ok(), wanted, "{table:?} {text}");
                if let Err(said) = found {
                    assert!(said.contains("may be ") && said.contains("1250 or "), "{said}");
                }
            }
            // These are one number in any table.
            for (text, wanted) in [
                ("0,005", 0.005),
                ("0.005", 0.005),
                (",125", 0.125),
                ("1,5", 1.5),
                ("1.25", 1.25),
                ("1234,567", 1234.567),
                ("1.250e3", 1250.0),
                ("1,250E+1", 12.5),
                ("200000", 200_000.0),
                ("+4e-4", 4e-4),
            ] {
                assert_eq!(of(table, text), Ok(wanted), "{table:?}");
            }
            for text in ["1,200.5", "1,2,3", "1.250.000", "200 000", "x", "", ",", "1,2e", "0,5 m"]
            {
                let said = of(table, text).unwrap_err();
                assert!(said.contains("is no number such as"), "{text}: {said}");
            }
        }
    }
}
