//! Files of several channels: which one is taken.

use super::component::{self, Component};
use super::hints::RecordHints;
use super::shown::shown;
use super::{RecordError, Stated};

/// A channel of a file, and its part of the text.
pub(super) struct Channel<'a> {
    /// Its number, where the file tells it.
    pub number: Option<u32>,
    /// Its direction, in the file's word.
    pub word: &'a str,
    /// Which component that is.
    pub component: Option<Component>,
    /// Lines before its own.
    pub before: usize,
    /// Its lines, and all after them.
    pub text: &'a str,
}

impl Channel<'_> {
    /// Its name in messages: `2 (Up)`.
    fn name(&self, place: usize) -> String {
        let number = self.number.map_or(place + 1, |number| number as usize);
        match self.word.is_empty() {
            true => number.to_string(),
            false => format!("{number} ({})", shown(self.word)),
        }
    }

    /// True of the channel that a word means: its number, or its direction.
    fn is_called(&self, asked: &str) -> bool {
        // E-W is EW, and an azimuth may begin with zeros.
        let plain = |word: &str| {
            let upper = word.to_uppercase();
            let is_left_out = |c: char| c.is_whitespace() || c == '-';
            let word: String =
                upper.trim_end_matches("DEG").chars().filter(|c| !is_left_out(*c)).collect();
            word.parse::<f64>().map_or(word.clone(), |degrees| degrees.to_string())
        };
        let vertical = |component: Option<Component>| component.filter(|c| c.is_vertical());
        plain(asked) == plain(self.word)
            || vertical(Component::named(asked))
                .is_some_and(|up| vertical(self.component) == Some(up))
    }
}

/// The parts of a text that begin with a line of some kind, with the lines before each.
pub(super) fn parts(text: &str, begins: impl Fn(&str) -> bool) -> Vec<(usize, &str)> {
    let (mut at, mut parts) = (0, Vec::new());
    for (number, line) in text.split_inclusive('\n').enumerate() {
        if begins(line) {
            parts.push((number, &text[at..]));
        }
        at += line.len();
    }
    parts
}

/// The channel that is taken, and what has to be said of that: the one that was requested; else the first that can be
/// the wanted component.
pub(super) fn choose<'a>(
    channels: Vec<Channel<'a>>,
    hints: &RecordHints,
    stated: &mut Stated,
) -> Result<(Channel<'a>, Option<String>), RecordError> {
    let count = channels.len();
    if count > 1 {
        let of = |(place, channel): (usize, &Channel<'_>)| {
            let number = channel.number.map_or(place + 1, |number| number as usize);
            (number.to_string(), channel.component)
        };
        stated.channels = channels.iter().enumerate().map(of).collect();
    }
    let names: Vec<String> =
        channels.iter().enumerate().map(|(place, channel)| channel.name(place)).collect();
    let all = || names.iter().take(12).cloned().collect::<Vec<_>>().join(", ");
    let (place, note) = if let Some(asked) = &hints.channel {
        let number = asked.trim().parse::<u32>().ok();
        let numbered = |(place, channel): (usize, &Channel<'_>)| {
            number.is_some() && number == channel.number.or(u32::try_from(place + 1).ok())
        };
        let found = channels.iter().enumerate().position(numbered);
        let found = found.or_else(|| channels.iter().position(|channel| channel.is_called(asked)));
        let Some(found) = found else {
            let key = hints.channel_key();
            let problem =
                format!("no channel '{}'; give `{key}` as one of {}", shown(asked), all());
            return Err(RecordError::whole(problem));
        };
        stated.channel = Some(asked.clone());
        (
            found,
            (count > 1).then(|| format!("channel {} of {count} is taken, as asked", names[found])),
        )
    } else {
        let wanted = |channel: &Channel<'_>| match (hints.vertical, channel.component) {
            (Some(vertical), Some(component)) => vertical == component.is_vertical(),
            (Some(vertical), None) => !vertical,
            (None, _) => true,
        };
        match channels.iter().position(wanted) {
            _ if count == 1 => (0, None),
            Some(0) | None => {
                (0, Some(format!("the first of {count} channels is taken, {}", names[0])))
            }
            Some(place) => {
                let kind = if hints.vertical == Some(true) { "vertical" } else { "horizontal" };
                let note =
                    format!("the first {kind} of {count} channels is taken, {}", names[place]);
                (place, Some(note))
            }
        }
    };
    match channels.into_iter().nth(place) {
        Some(channel) => {
            stated.azimuth = component::azimuth(channel.word);
            Ok((channel, note))
        }
        None => Err(RecordError::whole("no channel of acceleration; give the acceleration file")),
    }
}
