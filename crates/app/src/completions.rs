//! `topple completions` and `topple man`, made of the same definitions as the help.

use clap_complete::{Shell, generate};
use clap_mangen::Man;

use super::{InputError, arguments, examples, print};

/// Print the completions of a shell.
#[derive(clap::Args)]
#[command(after_help = examples::COMPLETIONS)]
pub struct CompletionsCommand {
    /// The shell
    shell: Shell,
}

impl CompletionsCommand {
    /// Prints the completions.
    pub fn run(&self) -> anyhow::Result<()> {
        let mut text = Vec::new();
        generate(self.shell, &mut arguments(), "topple", &mut text);
        print::text(String::from_utf8(text)?);
        Ok(())
    }
}

/// Print the manual page of topple or of one of its commands.
#[derive(clap::Args)]
#[command(after_help = examples::MAN)]
pub struct ManCommand {
    /// The command [default: topple itself]
    command: Option<String>,
}

impl ManCommand {
    /// Prints the page.
    pub fn run(&self) -> anyhow::Result<()> {
        let mut whole = arguments();
        // Its commands then know their whole names.
        whole.build();
        let page = match &self.command {
            None => whole,
            Some(name) => {
                let known: Vec<&str> = whole.get_subcommands().map(|own| own.get_name()).collect();
                let problem = format!("{name} is no command; there are {}", known.join(", "));
                let own = whole.find_subcommand(name).ok_or(InputError(problem))?;
                let title = format!("topple-{name}");
                own.clone().name(title)
            }
        };
        let mut text = Vec::new();
        Man::new(page).render(&mut text)?;
        print::text(String::from_utf8(text)?);
        Ok(())
    }
}
