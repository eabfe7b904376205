//! Which files without a list are one motion: by their names; where these say nothing, or leave a component out, by the
//! station, the earthquake and the direction that the files state.

use std::collections::{BTreeMap, BTreeSet};

use super::entry::Entry;
use super::files::Files;
use super::names::{self, Component};
use super::unused::LARGEST;
use topple::scene::record::{RecordHints, Stated, read};
use topple::scene::shown::shown;
use topple::work::parallel;

/// Files that are looked into for what they state; of more the names alone count.
const LOOKED_AT: usize = 2000;

/// A component of a motion: a file, or a channel of one.
#[derive(Debug, Clone)]
struct Part {
    file: String,
    channel: Option<String>,
}

/// The components of one recording.
#[derive(Debug, Default)]
struct Group {
    /// Its place among the others.
    order: String,
    horizontal: Vec<Part>,
    vertical: Vec<Part>,
    /// What was decided by what the files state, in words.
    note: Option<String>,
}

impl Group {
    fn add(&mut self, part: Part, component: Component) {
        match component {
            Component::Horizontal => self.horizontal.push(part),
            Component::Vertical => self.vertical.push(part),
        }
    }

    fn is_whole(&self) -> bool {
        !self.horizontal.is_empty() && !self.vertical.is_empty()
    }

    /// The same without files whose names say that they are of several recordings.
    fn without_strangers(mut self) -> Group {
        let own: BTreeSet<String> =
            self.files().filter_map(|file| Some(names::read(file)?.group)).collect();
        if own.len() > 1 {
            let unnamed = |part: &Part| names::read(&part.file).is_none();
            self.horizontal.retain(unnamed);
            self.vertical.retain(unnamed);
        }
        self
    }

    fn files(&self) -> impl Iterator<Item = &str> {
        self.horizontal.iter().chain(&self.vertical).map(|part| part.file.as_str())
    }

    /// The lines of its motions: one of each horizontal, with the vertical.
    fn entries(self) -> Vec<Entry> {
        let Group { horizontal, vertical, note, .. } = self;
        let of = |part: &Part| {
            let mut entry = Entry::of(&part.file);
            if let Some(channel) = &part.channel {
                entry.id = format!("{} {channel}", entry.id);
            }
            entry.channels[0].clone_from(&part.channel);
            entry.notes.extend(note.clone());
            entry
        };
        if let ([], [part, ..]) = (&horizontal[..], &vertical[..]) {
            let mut entry = of(part);
            entry.missing = Some("a vertical without a horizontal".into());
            return vec![entry];
        }
        let name = |part: &Part| match &part.channel {
            Some(channel) => format!("channel {channel} of {}", part.file),
            None => part.file.clone(),
        };
        let whole = |part: &Part| {
            let mut entry = of(part);
            match &vertical[..] {
                [] => {}
                [one] => {
                    entry.vertical = Some(one.file.clone());
                    entry.channels[1].clone_from(&one.channel);
                }
                [one, other, ..] => {
                    entry.missing = Some(format!(
                        "{} verticals may belong to it ({}, {}); say in a list which one does",
                        vertical.len(),
                        name(one),
                        name(other)
                    ));
                }
            }
            entry
        };
        horizontal.iter().map(whole).collect()
    }
}

/// The lines of files without a list, and the files that tell nothing.
pub(super) fn entries(files: &[&str], all: &Files) -> (Vec<Entry>, Vec<String>) {
    let (named, unnamed) = by_names(files);
    let (mut groups, broken): (Vec<Group>, Vec<Group>) =
        named.into_iter().partition(Group::is_whole);
    let of_broken = broken.iter().flat_map(Group::files).map(String::from);
    let open: Vec<String> = unnamed.iter().cloned().chain(of_broken).collect();
    let (whole, others): (Vec<Group>, Vec<Group>) =
        by_fields(&open, all).into_iter().partition(Group::is_whole);
    let mut taken: BTreeSet<String> =
        whole.iter().flat_map(Group::files).map(String::from).collect();
    groups.extend(whole);
    // What the files leave open is as their names have it.
    for group in broken {
        let rest = |parts: Vec<Part>| -> Vec<Part> {
            parts.into_iter().filter(|part| !taken.contains(&part.file)).collect()
        };
        let left =
            Group { horizontal: rest(group.horizontal), vertical: rest(group.vertical), ..group };
        taken.extend(left.files().map(String::from).collect::<Vec<_>>());
        groups.push(left);
    }
    for group in others {
        if group.files().all(|file| !taken.contains(file)) {
            taken.extend(group.files().map(String::from).collect::<Vec<_>>());
            groups.push(group);
        }
    }
    groups.sort_by(|one, other| one.order.cmp(&other.order));
    let entries = groups.into_iter().flat_map(Group::entries).collect();
    (entries, unnamed.into_iter().filter(|name| !taken.contains(name)).collect())
}

/// The recordings of files whose names are of a known pattern, and the files whose names say nothing.
fn by_names(files: &[&str]) -> (Vec<Group>, Vec<String>) {
    let mut unnamed = Vec::new();
    let mut groups: BTreeMap<String, Group> = BTreeMap::new();
    for &file in files {
        match names::read(file) {
            None => unnamed.push(file.to_string()),
            Some(named) => {
                let part = Part { file: file.into(), channel: None };
                let group = groups.entry(named.group.clone()).or_default();
                group.order = named.group;
                group.add(part, named.component);
            }
        }
    }
    (groups.into_values().collect(), unnamed)
}

/// The recordings of files by what these state.
fn by_fields(files: &[String], all: &Files) -> Vec<Group> {
    let looked_at = &files[..files.len().min(LOOKED_AT)];
    let stated: Vec<Option<Stated>> =
        parallel::each(looked_at.len(), 1, |number| stated(&looked_at[number], all));
    let mut groups: BTreeMap<[String; 4], Group> = BTreeMap::new();
    for (file, stated) in looked_at.iter().zip(stated) {
        let Some(stated) = stated else { continue };
        let parts = parts(file, &stated);
        let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder).to_string();
        let station = stated.station.to_lowercase();
        // Channels of one file belong together whatever it states.
        let (key, how) = if stated.channels.len() > 1 {
            (
                [folder, file.clone(), String::new(), String::new()],
                "channels of one file".to_string(),
            )
        } else if station.is_empty() {
            continue;
        } else {
            let event = stated.event.to_lowercase();
            let how = format!("paired by what the files state, station {}", shown(&stated.station));
            // A stream that is not corrected is no component of one that is.
            let format = format!("{} {:?}", stated.format, stated.corrected);
            ([folder, format, event, station], how)
        };
        for (part, component) in parts {
            let group = groups.entry(key.clone()).or_default();
            if group.note.is_none() {
                (group.order, group.note) = (format!("{}/{file}", key[0]), Some(how.clone()));
            }
            group.add(part, component);
        }
    }
    groups.into_values().map(Group::without_strangers).collect()
}

/// What a file states, if it is a record of a size that is looked into.
fn stated(file: &str, all: &Files) -> Option<Stated> {
    let bytes = all.peek(file, LARGEST as u64)?;
    read::bytes(&bytes, &RecordHints::default()).ok().map(|record| record.stated)
}

/// The components of a file, of which each has a direction.
fn parts(file: &str, stated: &Stated) -> Vec<(Part, Component)> {
    let component = |one: topple::scene::record::Component| match one.is_vertical() {
        true => Component::Vertical,
        false => Component::Horizontal,
    };
    let part = |channel| Part { file: file.into(), channel };
    if stated.channels.len() > 1 {
        let of = |(channel, one): &(String, Option<topple::scene::record::Component>)| {
            Some((part(Some(channel.clone())), component((*one)?)))
        };
        return stated.channels.iter().filter_map(of).collect();
    }
    stated.component.map(|one| (part(None), component(one))).into_iter().collect()
}
