//! What happens to files: bits that flip, ends that are missing, pieces that stand twice, numbers that are others.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;

/// Numbers that are extreme, or none.
const NUMBERS: &str = "0 -0 -1 1 2 0.5 1e-9 1e-300 5e-324 1e9 1e20 1e308 1e309 -1e308 nan NaN inf -inf 255 65536 1048577 \
    4294967295 4294967296 9223372036854775808 18446744073709551615 99999999999999999999999999";
/// Words of some reader's language, and what no reader expects.
const WORDS: [&str; 16] = [
    ":", ",", ",,,,", ";", "=", "\"", "[", "[[", "{", "}", "\n", "\0", "\u{feff}", "\u{3c0}", "  ",
    "1:2:3",
];
/// A file is not damaged into one of more bytes.
const LONGEST: usize = 1 << 18;

/// Random numbers of a case.
pub struct Chance(Pcg64Mcg);

impl Chance {
    /// Of a seed: the same one gives the same damage.
    pub fn of(seed: u64) -> Chance {
        let mut random = Pcg64Mcg::new(u128::from(seed) << 64 | 1);
        // The first numbers of near seeds are near.
        for _ in 0..8 {
            random.next_u64();
        }
        Chance(random)
    }

    /// A whole number below another.
    pub fn below(&mut self, end: usize) -> usize {
        ((u128::from(self.0.next_u64()) * end.max(1) as u128) >> 64) as usize
    }

    /// One of some.
    pub fn one<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }
}

/// A file with some damage.
pub fn damaged(file: &[u8], chance: &mut Chance) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..1 + chance.below(3) {
        once(&mut bytes, chance);
        bytes.truncate(LONGEST);
    }
    bytes
}

fn once(bytes: &mut Vec<u8>, chance: &mut Chance) {
    let length = bytes.len();
    let at = chance.below(length + 1);
    match chance.below(14) {
        0 if at < length => bytes[at] ^= 1 << chance.below(8),
        1 => bytes.truncate(at),
        2 => {
            let end = at + chance.below(length - at + 1);
            bytes.drain(at..end);
        }
        // Once more, or very often.
        3 => {
            let end = (at + 1 + chance.below(40)).min(length);
            let times = [1, 2, 1000][chance.below(3)];
            let piece = bytes[at..end].repeat(times);
            bytes.splice(at..at, piece);
        }
        4 => {
            let tail = bytes[at..].to_vec();
            bytes.extend(tail);
        }
        5 => {
            let word = chance.one(&WORDS).as_bytes();
            bytes.splice(at..at, word.iter().copied());
        }
        // A length in a header, in either order of its bytes.
        6 if length >= 8 => {
            let width = [2, 4, 8][chance.below(3)];
            let number =
                *chance.one(&[0, 1, 0xff, 0xffff, 0x7fff_ffff, 0xffff_fff0, u64::MAX, 1 << 63]);
            let at = chance.below(length - width + 1);
            let (low, high) = (number.to_le_bytes(), number.to_be_bytes());
            let written = if chance.below(2) == 0 { &low[..width] } else { &high[8 - width..] };
            bytes[at..at + width].copy_from_slice(written);
        }
        _ => replace_number(bytes, chance),
    }
}

/// Puts another number in the place of one.
fn replace_number(bytes: &mut Vec<u8>, chance: &mut Chance) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
    let begins: Vec<usize> = (0..bytes.len())
        .filter(|at| bytes[*at].is_ascii_digit() && (*at == 0 || !is_part(&bytes[at - 1])))
        .collect();
    let Some(start) = (!begins.is_empty()).then(|| *chance.one(&begins)) else { return };
    let end = start + bytes[start..].iter().take_while(|byte| is_part(byte)).count();
    let numbers: Vec<&str> = NUMBERS.split(' ').collect();
    let number = chance.one(&numbers).as_bytes();
    bytes.splice(start..end, number.iter().copied());
}
