use clap::Command;

use topple_app::arguments;

/// The commands of a help: a line that ends with a backslash goes on.
fn commands(help: &str) -> Vec<String> {
    let (_, examples) = help.split_once("Examples:").unwrap_or_default();
    let pieces: Vec<&str> = examples.split("\\\n").map(str::trim_start).collect();
    let joined = pieces.join("");
    // What it does stands after it where there is room.
    let command = |line: &str| line.trim().split("     ").next().unwrap_or_default().to_string();
    let commands = joined.lines().map(command);
    commands.filter(|line| line == "topple" || line.starts_with("topple ")).collect()
}

#[test]
fn every_example_is_a_command_that_a_shell_takes() {
    let whole = arguments();
    let of = |own: &Command| own.get_after_help().map(ToString::to_string).unwrap_or_default();
    let helps = std::iter::once(&whole).chain(whole.get_subcommands()).map(of);
    let mut count = 0;
    for command in helps.flat_map(|help| commands(&help)) {
        // Outside of quotes no letter means something to a shell; within them all are as they stand.
        let plain = command.split('\'').step_by(2);
        assert!(!plain.clone().any(|part| part.contains(['(', '*', '?', '[', '$'])), "{command}");
        let words = command.split_whitespace().map(|word| word.trim_matches('\''));
        let parsed = arguments().try_get_matches_from(words);
        assert!(parsed.is_ok(), "{command}: {}", parsed.err().unwrap());
        count += 1;
    }
    assert!(count > 30, "{count} examples");
}

#[test]
fn no_line_of_a_help_is_wider_than_the_terminal() {
    for width in [60, 80, 132] {
        let mut whole = arguments().term_width(width);
        whole.build();
        let mut all = vec![whole.clone()];
        all.extend(whole.get_subcommands().cloned());
        for mut own in all {
            let helps = [own.render_help(), own.render_long_help()];
            for help in helps.map(|help| help.to_string()) {
                let wide = help.lines().find(|line| line.chars().count() > width);
                assert_eq!(wide, None, "{} {width}", own.get_name());
            }
        }
    }
}

#[test]
fn flags_stand_under_the_heading_of_what_they_do() {
    let whole = arguments();
    let of = |own: &Command, flag: &str| {
        let flag = own.get_arguments().find(|arg| arg.get_long() == Some(flag)).cloned();
        flag.and_then(|flag| flag.get_help_heading().map(String::from))
    };
    for name in ["pulse", "seismic", "envelope", "fragility", "compare"] {
        let own = whole.find_subcommand(name).unwrap();
        for flag in ["resume", "tile", "verify", "dry-run"] {
            assert_eq!(of(own, flag).as_deref(), Some("Computing"), "{name} --{flag}");
        }
        assert_eq!(of(own, "title").as_deref(), Some("Pictures"), "{name}");
    }
    // Without other headings around they are options.
    assert_eq!(of(&whole, "resume"), None);
    assert_eq!(
        of(whole.find_subcommand("history").unwrap(), "columns").as_deref(),
        Some("Computing")
    );
}

#[test]
fn every_command_with_flags_of_a_scene_has_examples() {
    for own in arguments().get_subcommands() {
        if own.get_arguments().count() > 0 && own.get_name() != "help" {
            let help = own.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(help.contains("Examples:"), "{}", own.get_name());
        }
    }
}
