//! `topple explore`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use topple::backend::request::BackendRequest;
use topple::results::files::WriteError;
use topple::scene::builder::SceneBuilder;
use topple_explore::export::{ExportError, export};
use topple_explore::records::Records;
use topple_explore::server::Server;
use topple_explore::session::{Session, Settings};
use topple_explore::start;

use super::errors::{not_exported, sweep_error};
use super::scene::DEFAULT_SCENE;
use super::words::{self, Reporter};
use super::written::one_of;
use super::{InputError, examples, interrupt, load, options};

/// Show a map that follows sliders, on a page in the browser.
///
/// The page is served on this machine only, at an address that cannot be guessed. Ctrl-C ends the server.
#[derive(clap::Args)]
#[command(after_help = examples::EXPLORE)]
pub struct ExploreCommand {
    /// Scene file (TOML) [default: the scene of the command topple without arguments]
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Port of the page's address; 0 takes any free port
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Do not open a browser
    #[arg(long)]
    no_open: bool,
    /// Write the page to a folder and end. Any static web server can serve the folder; the page computes in the browser by WebGPU
    #[arg(long, value_name = "DIR", conflicts_with_all = ["port", "no_open"])]
    export: Option<PathBuf>,
    /// What computes; auto takes a real GPU if there is one, else the CPU [default: auto]
    #[arg(long, value_parser = one_of::<BackendRequest>())]
    backend: Option<BackendRequest>,
    /// GPUs to use, by their numbers in topple adapters [default: all that are of the same kind as the best one]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    adapter: Vec<usize>,
    /// Accept implausible numbers
    #[arg(long)]
    force: bool,
    /// Threads of the CPU [default: one per core]
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

impl ExploreCommand {
    /// Serves the page.
    pub fn run(&self) -> anyhow::Result<()> {
        options::set_threads(self.threads)?;
        let (given, folder) = match &self.scene {
            Some(path) => (load::given(path, self.force)?, path.parent().unwrap_or(Path::new(""))),
            // The scene is part of the binary; a test reads it.
            None => {
                let scene = SceneBuilder::from_toml(DEFAULT_SCENE).map_err(anyhow::Error::msg)?;
                (scene, Path::new(""))
            }
        };
        let scene = match &self.scene {
            Some(path) => load::check(path, &given)?,
            None => given.check().map_err(|error| options::flag_error(&error))?,
        };
        let records = Records::default();
        let first = start::first(&records, &scene, &given, folder);
        let backend = self.backend.unwrap_or(BackendRequest::Auto);
        let settings = Settings { backend, adapters: self.adapter.clone() };
        let session = Session::open(settings, records, first).map_err(sweep_error)?;
        interrupt::listen();
        if let Some(folder) = &self.export {
            return write(folder, &session);
        }
        let server =
            Server::bind(self.port).map_err(|error| InputError(format!("--port: {error}")))?;
        let address = server.address();
        Reporter::unless(false).line("explore", &address);
        if !self.no_open && open::that_detached(&address).is_err() {
            words::warn("no browser opens; open the address above");
        }
        server.serve(session, interrupt::asked)?;
        Ok(())
    }
}

/// Writes the page of a session to a folder.
fn write(folder: &Path, session: &Session) -> anyhow::Result<()> {
    let bytes = export(folder, session, interrupt::flag()).map_err(|error| match error {
        ExportError::Occupied(_) | ExportError::Write(WriteError::Directory { .. }) => {
            InputError(format!("--export: {error}")).into()
        }
        ExportError::Refused(refused) if refused.cancelled => not_exported(),
        error => anyhow::Error::from(error),
    })?;
    let size = bytes.div_ceil(1 << 20);
    Reporter::unless(false)
        .line("page", format!("{} ({size} MiB): serve it by any web server", folder.display()));
    Ok(())
}
