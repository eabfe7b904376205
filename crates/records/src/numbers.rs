//! The numbers of a line: as FORTRAN and other programs write them, in columns or one after another.

/// A finite number as FORTRAN writes it: no leading zero, a D for an exponent, or none before one of three digits
/// (`0.1234567-104`); with a long minus.
pub fn number(field: &str) -> Option<f64> {
    let field = field.trim();
    if let Ok(value) = field.parse::<f64>() {
        return value.is_finite().then_some(value);
    }
    // Long minus signs are a word processor's.
    let mut plain = field.replace(['\u{2212}', '\u{2013}'], "-").replace(['D', 'd'], "E");
    if let Some(at) = bare_exponent(&plain).filter(|at| at + 4 == plain.len()) {
        plain.insert(at, 'E');
    }
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Where the sign of an exponent without its letter stands: after a number with a point, before three digits and no more.
fn bare_exponent(word: &str) -> Option<usize> {
    let bytes = word.as_bytes();
    let from = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mantissa =
        bytes.get(from..)?.iter().take_while(|c| c.is_ascii_digit() || **c == b'.').count();
    let at = from + mantissa;
    let digits = bytes.get(at + 1..)?.iter().take_while(|c| c.is_ascii_digit()).count();
    let ends = !matches!(bytes.get(at + 1 + digits), Some(b'.' | b'e' | b'E' | b'd' | b'D'));
    let is_one = matches!(bytes[at], b'+' | b'-')
        && word[from..at].contains('.')
        && mantissa > 1
        && digits == 3
        && ends;
    is_one.then_some(at)
}

/// The fields of a line between blanks and commas; also those of numbers that touch: before a sign that no exponent
/// owns, and where the digits of one number end and the next has begun.
pub fn free(line: &str) -> Vec<&str> {
    let mut fields = Vec::new();
    for word in line.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"')) {
        let (mut from, mut before) = (0, ' ');
        let mut own = bare_exponent(word);
        for (at, c) in word.char_indices() {
            let sign = c == '-' || c == '+';
            if sign && at > from && !matches!(before, 'e' | 'E' | 'd' | 'D') && own != Some(at) {
                touching(&word[from..at], &mut fields);
                from = at;
                own = bare_exponent(&word[at..]).map(|own| at + own);
            }
            before = c;
        }
        if from < word.len() {
            touching(&word[from..], &mut fields);
        }
    }
    fields
}

/// A word, or the numbers without signs that touch in it (`1.0E-022.0E-02`, `0.12340.5678`): each has as many digits
/// after its point as the last one.
fn touching<'a>(word: &'a str, fields: &mut Vec<&'a str>) {
    let points = word.bytes().filter(|c| *c == b'.').count();
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let decimals = word.rsplit_once('.').map_or(0, |(_, rest)| digits(rest));
    if points < 2 || decimals == 0 || !word.is_ascii() {
        fields.push(word);
        return;
    }
    let exponent = |text: &str| -> usize {
        let letter = usize::from(text.starts_with(['e', 'E', 'd', 'D']));
        if letter == 0 {
            return 0;
        }
        letter + usize::from(text[letter..].starts_with(['+', '-']))
    };
    // Exponents have two digits, of FORTRAN and C alike.
    let mut cuts = Vec::new();
    let mut from = 0;
    while from < word.len() {
        let Some(point) = word[from..].find('.').map(|point| from + point) else { break };
        let mantissa = (point + 1 + decimals).min(word.len());
        let sign = exponent(&word[mantissa..]);
        let to = if sign == 0 { mantissa } else { (mantissa + sign + 2).min(word.len()) };
        cuts.push(&word[from..to]);
        from = to;
    }
    match from == word.len() && cuts.iter().all(|cut| number(cut).is_some()) {
        true => fields.extend(cuts),
        false => fields.push(word),
    }
}

/// The width of a field of a FORTRAN format such as `Format=(1E15.6)`, `(8f10.6)` in a line.
pub fn width(line: &str) -> Option<usize> {
    let upper = line.to_ascii_uppercase();
    upper.split('(').skip(1).find_map(|inside| {
        let inside = inside.trim_start();
        // Scale factors and counts stand before the letter: 1P5E15.7.
        let letter = inside.find(['E', 'F', 'I', 'G'])?;
        if !inside[..letter].bytes().all(|c| c.is_ascii_digit() || matches!(c, b'P' | b',' | b' '))
        {
            return None;
        }
        let digits: String =
            inside[letter + 1..].chars().take_while(char::is_ascii_digit).collect();
        digits.parse().ok().filter(|width| (1..=64).contains(width))
    })
}

/// The fields of a line in columns of `width` characters; blank ones at the end do not count.
pub fn fixed(line: &str, width: usize) -> Vec<&str> {
    let line = line.trim_end();
    let mut fields = Vec::new();
    let mut from = 0;
    while from < line.len() {
        let mut to = (from + width.max(1)).min(line.len());
        // A file of another encoding may hold longer characters; they are no numbers anyway.
        while !line.is_char_boundary(to) {
            to += 1;
        }
        fields.push(&line[from..to]);
        from = to;
    }
    fields
}

/// The number after a key such as `NPTS=` (the equals sign may be missing) in a line.
pub fn after(line: &str, key: &str) -> Option<f64> {
    let upper = line.to_ascii_uppercase();
    let at = upper.find(key)? + key.len();
    let rest = line.get(at..)?.trim_start_matches([' ', '=', ':', '\t']);
    let end = rest
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'E' | 'e')))
        .unwrap_or(rest.len());
    number(&rest[..end])
}
