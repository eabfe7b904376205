//! One stream in two processings, as it was recorded and corrected: which of two files is which.

use std::collections::HashMap;

use super::entry::{Entry, Motion};
use topple::scene::record::Stated;

/// Words for what is not corrected and for what is, as the name of a folder has them.
const FOLDERS: [(&[&str], bool); 2] = [
    (&["raw", "unprocessed", "uncorrected", "v1", "vol1", "volume1"], false),
    (&["processed", "corrected", "v2", "vol2", "volume2"], true),
];
/// The same of a part of a file's name, as ESM's and ITACA's have it between points.
const PARTS: [(&[&str], bool); 2] = [(&["u", "cv"], false), (&["c", "ap", "mp"], true)];
/// The same of a word within a file's name, between dashes, underlines or blanks.
const WITHIN: [(&[&str], bool); 2] =
    [(&["raw", "unprocessed", "uncorrected"], false), (&["processed", "corrected"], true)];
/// The same of the ending of a file of CESMD.
const ENDINGS: [(&[&str], bool); 2] =
    [(&["v1", "v1a", "v1c", "raw"], false), (&["v2", "v2a", "v2c"], true)];

/// What a word says of the processing.
fn of_word(word: &str, words: &[(&[&str], bool)]) -> Option<bool> {
    let plain: String = word.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
    words.iter().find(|(known, _)| known.contains(&&*plain)).map(|(_, corrected)| *corrected)
}

/// The name of a file without what it says of the processing, and whether that is a corrected one.
pub fn of_name(name: &str) -> Option<(String, bool)> {
    let mut said = None;
    let mut plain = |word: &str, words: &[(&[&str], bool)]| match of_word(word, words) {
        Some(corrected) => {
            said = Some(corrected);
            "*".to_string()
        }
        None => word.to_lowercase(),
    };
    let (folders, file) = name.rsplit_once('/').unwrap_or(("", name));
    let folders: Vec<String> = folders.split('/').map(|folder| plain(folder, &FOLDERS)).collect();
    let parts: Vec<&str> = file.split('.').collect();
    let last = parts.len() - 1;
    // ESM: network, station, location, channel, and others: HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC.
    let of_esm = parts.len() > 6;
    let mut within = |part: &str| -> String {
        part.split(['-', '_', ' ']).map(|word| plain(word, &WITHIN)).collect::<Vec<_>>().join("_")
    };
    let mut named: Vec<String> = parts.iter().map(|part| within(part)).collect();
    for (at, part) in parts.iter().enumerate() {
        if of_esm && at > 4 {
            named[at] = plain(part, &PARTS);
        } else if !of_esm && at == last && at > 0 {
            named[at] = plain(part, &ENDINGS);
        }
    }
    said.map(|corrected| (format!("{}/{}", folders.join("/"), named.join(".")), corrected))
}

/// The same by what a file states: the earthquake, the station and the azimuth are those of the stream.
pub(super) fn of_stated(stated: &Stated) -> Option<(String, bool)> {
    let Stated { event, station, azimuth, .. } = stated;
    let known = !event.is_empty() && !station.is_empty();
    let stream = || Some(format!("{event}\n{station}\n{}", (*azimuth)?));
    known.then(stream)?.zip(stated.corrected)
}

/// Leaves out motions of files that are not corrected where the corrected files of the same stream are a motion, too: by what
/// the files state, or by their names. What a list names is as the list says.
pub(super) fn leave_out_uncorrected(rows: &mut [(Entry, Result<Motion, String>)]) {
    let mut corrected: HashMap<&str, &str> = HashMap::new();
    for (entry, motion) in &*rows {
        if let (Ok(_), Some(streams)) = (motion, streams(entry, true)) {
            corrected.extend(streams.map(|stream| (stream, &*entry.id)));
        }
    }
    let twin = |(entry, motion): &(Entry, Result<Motion, String>)| {
        let mut streams = motion.as_ref().ok().and(streams(entry, false))?;
        streams.find_map(|stream| corrected.get(stream).map(|id| (*id).to_string()))
    };
    let twins: Vec<Option<String>> = rows.iter().map(twin).collect();
    for ((entry, motion), twin) in rows.iter_mut().zip(twins) {
        let Some(twin) = twin.filter(|_| !entry.listed) else { continue };
        *motion = Err(format!("not corrected; the corrected record of the same stream is {twin}"));
    }
}

/// The streams of a motion by what its file states and by its name, if it is a corrected one or not as is asked.
fn streams(entry: &Entry, corrected: bool) -> Option<impl Iterator<Item = &str>> {
    let is_it = entry.streams.iter().all(|(_, own)| *own == corrected);
    (is_it && !entry.streams.is_empty())
        .then(|| entry.streams.iter().map(|(stream, _)| stream.as_str()))
}
