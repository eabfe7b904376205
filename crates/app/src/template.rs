//! `topple scene`: a scene file to start from, with every key and what it means.

use topple::scene::keys::words;
use topple::scene::parameters::{PARAMETERS, Section};

use super::arguments;
use super::print::print_line;
use super::scene::DEFAULT_SCENE;

/// Prints the default scene with all that it could say besides.
pub fn run() {
    print_line!("{}", text().trim_end());
}

/// The lines of a scene file that give a key, by the table that they stand in.
fn given(scene: &str) -> Vec<(&str, &str)> {
    let mut section = "";
    let mut lines = Vec::new();
    for line in scene.lines() {
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            section = name;
        } else if line.contains(" = ") && !line.starts_with('#') {
            lines.push((section, line));
        }
    }
    lines
}

fn text() -> String {
    let arguments = arguments();
    // A history has every flag that a scene has.
    let flags = arguments.find_subcommand("history");
    let help = |key: &str| {
        let flag = flags.and_then(|flags| flags.get_arguments().find(|flag| flag.get_id() == key));
        let help = flag.and_then(|flag| flag.get_help()).map(ToString::to_string);
        help.unwrap_or_default().replace('\n', " ")
    };
    let given = given(DEFAULT_SCENE);
    let mut lines = vec![
        "# A scene for topple run. Lines that begin with # say what a key means, or give it another value.".into(),
        "# A number is one value, \"start:stop:count\", \"start:stop:count:log\" or \"a,b,c\"; SI units.".into(),
        String::new(),
    ];
    // Its title is of its own block.
    lines.extend(
        given.iter().filter(|(section, _)| section.is_empty()).map(|(_, line)| format!("# {line}")),
    );
    for section in Section::ALL {
        lines.push(String::new());
        lines.push(match section {
            Section::Record => "# [record]   # in the place of [pulse]".into(),
            _ => format!("[{}]", section.key()),
        });
        let mut key = |key: &str, meaning: String, default: &str| {
            lines.push(format!("# {meaning}"));
            let is_it = |(of, line): &&(&str, &str)| {
                *of == section.key() && line.split(" = ").next() == Some(key)
            };
            lines.push(match given.iter().find(is_it) {
                Some((_, line)) => line.to_string(),
                None => format!("# {key} = {default}").trim_end().to_string(),
            });
        };
        for word in words(section) {
            key(word, help(word), "");
        }
        for entry in PARAMETERS.iter().filter(|entry| entry.section == section) {
            let unit =
                if entry.unit.is_empty() { String::new() } else { format!(", {}", entry.unit) };
            let default = entry.default;
            let is_number = default.parse::<f64>().is_ok();
            let words = match default {
                "" => String::new(),
                _ if is_number => String::new(),
                words => format!(" [default: {words}]"),
            };
            key(
                entry.key,
                format!("{}{unit}{words}", entry.meaning),
                if is_number { default } else { "" },
            );
        }
    }
    lines.join("\n")
}
