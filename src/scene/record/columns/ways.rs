//! Which way the words of a line call positive.

use super::super::Component;
use super::pieces::listed;
use super::sign_words::{self, Word};
use super::words;

/// What words state of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Polarity {
    Way(Component),
    /// The same of a recorder, of whose horizontal components they speak too: a file beside them may be any of the three.
    OfAll(Component),
    /// They speak of a sign, and not in words that are known.
    Unclear,
}

/// Words of a line whose way is not that of its accelerations now.
const OF_OTHERS: &str = "\
    latitude longitude lat lon long depth depths elevation location position coordinate coordinates original \
    originally was were rotated";

/// Words that are a reversal in the name of a column, or beside a vertical: a fault is reverse, and components are turned.
pub(super) const OF_NAMES: &str = "reverse rev opp inv turned changed";

fn opposite(way: Component) -> Component {
    match way {
        Component::Down => Component::Up,
        Component::Up => Component::Down,
        Component::Horizontal => way,
    }
}

/// The ways along the ground that a line calls positive, degrees from north over east; none where they are not clear.
pub(super) fn towards(line: &str) -> Vec<f64> {
    let words = sign_words::words(line);
    let mut ways = Vec::new();
    if words.iter().any(|(text, _)| listed(OF_OTHERS, text)) {
        return ways;
    }
    for part in words.split(|(_, one)| *one == Word::Other) {
        let has = |one: Word| part.iter().any(|(_, other)| *other == one);
        let positive = has(Word::Key(true)) || has(Word::Plus);
        let clear = positive != has(Word::Key(false)) && !has(Word::Not) && !has(Word::Minus);
        let of_part = part.iter().filter_map(|(_, one)| match one {
            Word::Toward(degrees) => *degrees,
            _ => None,
        });
        if clear {
            ways.extend(of_part.map(|way| if positive { way } else { (way + 180.0) % 360.0 }));
        }
    }
    ways
}

/// The ways that stand alone in the brackets of a column's name: `NS (south)`.
pub(super) fn in_brackets(name: &str) -> Vec<f64> {
    let mut ways = Vec::new();
    for text in words::in_brackets(name) {
        let words = sign_words::words(text);
        let of_ways = |one: Word| matches!(one, Word::Toward(Some(_)) | Word::Filling);
        if words.iter().all(|(_, one)| of_ways(*one)) {
            ways.extend(words.iter().filter_map(|(_, one)| match one {
                Word::Toward(degrees) => *degrees,
                _ => None,
            }));
        }
    }
    ways
}

/// The way of a vertical that a line states.
pub(super) fn way(line: &str, words: &[(String, Word)]) -> Option<Polarity> {
    let of_axis = words.iter().any(|(text, one)| *one == Word::Vertical || text == "axis");
    let words: Vec<(&str, Word)> = words
        .iter()
        .filter(|(_, one)| *one != Word::Filling)
        .map(|(text, one)| (text.as_str(), *one))
        .collect();
    let mut ways = Vec::new();
    let mut unclear = false;
    // What stands between other words is read by itself.
    for part in words.split(|(_, kind)| matches!(kind, Word::Other | Word::Reversed)) {
        match of_part(part, of_axis) {
            Some(Polarity::Way(way)) => ways.push(way),
            Some(_) => unclear = true,
            None => {}
        }
    }
    let [way, others @ ..] = &ways[..] else {
        return unclear.then_some(Polarity::Unclear);
    };
    let of_others = words.iter().any(|(text, _)| listed(OF_OTHERS, text));
    let answered = line.trim_end().strip_suffix('0').map(str::trim_end);
    let denied = answered.is_some_and(|line| line.ends_with([':', '=']))
        || matches!(words.last(), Some((_, Word::Not)));
    let agree = others.iter().all(|other| other == way);
    let of_all = words.iter().any(|(_, one)| one.is_horizontal());
    let reversed =
        words.iter().any(|(text, one)| *one == Word::Reversed && !listed(OF_NAMES, text));
    Some(match agree && !of_others && !denied && !reversed {
        true if of_all => Polarity::OfAll(*way),
        true => Polarity::Way(*way),
        false => Polarity::Unclear,
    })
}

/// A key and the way that it has; true where the key is no lone `-`.
type Pair = (Component, bool);

/// What words state that follow each other.
fn of_part(words: &[(&str, Word)], of_axis: bool) -> Option<Polarity> {
    let mut turned = false;
    let mut items: Vec<Word> = Vec::new();
    for (_, kind) in words {
        match *kind {
            Word::Not => turned = !turned,
            Word::Way(way) => {
                let way = if std::mem::take(&mut turned) { opposite(way) } else { way };
                if items.last() != Some(&Word::Way(way)) {
                    items.push(Word::Way(way));
                }
            }
            Word::Key(positive) => {
                let key = Word::Key(positive != std::mem::take(&mut turned));
                if items.last() != Some(&key) {
                    items.push(key);
                }
            }
            Word::Plus if items.last() != Some(&Word::Key(true)) => items.push(Word::Key(true)),
            Word::Minus | Word::Points => items.push(*kind),
            // An axis that points there is another one.
            one if one.is_horizontal() && items.last() == Some(&Word::Points) => {
                items.pop();
            }
            _ => {}
        }
    }
    let has_key = items.iter().any(|item| matches!(item, Word::Key(_) | Word::Minus));
    let has_way = items.iter().any(|item| matches!(item, Word::Way(_)));
    if has_key && has_way {
        let pairs: Option<Vec<Pair>> = items.chunks(2).map(pair).collect();
        let Some(pairs) = pairs.filter(|_| !turned) else { return Some(Polarity::Unclear) };
        let told = pairs.iter().any(|(_, sure)| *sure);
        let way = pairs.first().map(|(way, _)| *way)?;
        let agree = pairs.iter().all(|(other, _)| *other == way);
        return Some(if agree && told { Polarity::Way(way) } else { Polarity::Unclear });
    }
    let along = |one: &&(&str, Word)| one.1.is_toward();
    match items[..] {
        [Word::Points, Word::Way(way)] if of_axis => Some(Polarity::Way(way)),
        // The ways of all three components.
        [Word::Way(way)] if words.iter().filter(along).count() > 1 => Some(Polarity::Way(way)),
        [Word::Way(way)] => {
            let beside =
                |pair: &[(&str, Word)]| matches!(pair, [(_, Word::Vertical), (_, Word::Way(_))]);
            words.windows(2).any(beside).then_some(Polarity::Way(way))
        }
        _ => None,
    }
}

/// The positive way that a key and a way tell, in either order.
fn pair(items: &[Word]) -> Option<Pair> {
    let ((Word::Way(way), key) | (key, Word::Way(way))) = (*items.first()?, *items.get(1)?) else {
        return None;
    };
    match key {
        Word::Key(positive) => Some((if positive { way } else { opposite(way) }, true)),
        Word::Minus => Some((opposite(way), false)),
        _ => None,
    }
}
