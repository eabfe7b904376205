//! The files of the page, as they are served and exported.

use std::sync::LazyLock;

/// A file: its path below the page's address, its type, and its bytes.
pub struct File {
    /// `gpu/engine.js`.
    pub path: &'static str,
    /// Its media type.
    pub kind: &'static str,
    /// What it holds.
    pub bytes: &'static [u8],
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const PICTURE: &str = "image/svg+xml";
const PIXELS: &str = "image/png";

macro_rules! files {
    ($($path:literal: $kind:expr),* $(,)?) => {
        &[$(File { path: $path, kind: $kind, bytes: include_bytes!(concat!("page/", $path)) }),*]
    };
}

/// The page's files.
pub const FILES: &[File] = files![
    "index.html": HTML,
    "style.css": CSS,
    "icon.svg": PICTURE,
    "icon.png": PIXELS,
    "applies.js": SCRIPT,
    "axes.js": SCRIPT,
    "axis.js": SCRIPT,
    "block.js": SCRIPT,
    "cells.js": SCRIPT,
    "choices.js": SCRIPT,
    "clock.js": SCRIPT,
    "device.js": SCRIPT,
    "dialogs.js": SCRIPT,
    "dom.js": SCRIPT,
    "engine.js": SCRIPT,
    "explorer.js": SCRIPT,
    "fields.js": SCRIPT,
    "files.js": SCRIPT,
    "flow.js": SCRIPT,
    "frames.js": SCRIPT,
    "histories.js": SCRIPT,
    "ink.js": SCRIPT,
    "legend.js": SCRIPT,
    "loop.js": SCRIPT,
    "main.js": SCRIPT,
    "map.js": SCRIPT,
    "marks.js": SCRIPT,
    "motion.js": SCRIPT,
    "numbers.js": SCRIPT,
    "overlay.js": SCRIPT,
    "picture.js": SCRIPT,
    "plot.js": SCRIPT,
    "ranges.js": SCRIPT,
    "readout.js": SCRIPT,
    "row.js": SCRIPT,
    "scene.js": SCRIPT,
    "section.js": SCRIPT,
    "server.js": SCRIPT,
    "shades.js": SCRIPT,
    "sliders.js": SCRIPT,
    "state.js": SCRIPT,
    "strip.js": SCRIPT,
    "suggest.js": SCRIPT,
    "theme.js": SCRIPT,
    "tour.js": SCRIPT,
    "view.js": SCRIPT,
    "gpu/base_device.js": SCRIPT,
    "gpu/block.js": SCRIPT,
    "gpu/body.js": SCRIPT,
    "gpu/case.js": SCRIPT,
    "gpu/cell.js": SCRIPT,
    "gpu/clock.js": SCRIPT,
    "gpu/command.js": SCRIPT,
    "gpu/device.js": SCRIPT,
    "gpu/engine.js": SCRIPT,
    "gpu/errors.js": SCRIPT,
    "gpu/grid.js": SCRIPT,
    "gpu/groups.js": SCRIPT,
    "gpu/isolation.js": SCRIPT,
    "gpu/known.js": SCRIPT,
    "gpu/loaded.js": SCRIPT,
    "gpu/motion.js": SCRIPT,
    "gpu/outcome.js": SCRIPT,
    "gpu/pace.js": SCRIPT,
    "gpu/plan.js": SCRIPT,
    "gpu/pulse.js": SCRIPT,
    "gpu/range.js": SCRIPT,
    "gpu/record.js": SCRIPT,
    "gpu/refine.js": SCRIPT,
    "gpu/scene.js": SCRIPT,
    "gpu/stored.js": SCRIPT,
    "gpu/sweep.js": SCRIPT,
    "gpu/tables.js": SCRIPT,
    "gpu/tile.js": SCRIPT,
    "gpu/view.js": SCRIPT,
];

/// Its first file, which is served at the page's address.
pub const INDEX: &str = "index.html";

/// What computes for a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// The server that the page came from.
    Server,
    /// The reader's browser.
    WebGpu,
}

/// The line of the page that names its engine, as it is in its file.
const NAMED: &str = r#"<meta name="topple-engine" content="server">"#;

impl Engine {
    /// The line of the page that names it.
    fn line(self) -> &'static str {
        match self {
            Engine::Server => NAMED,
            Engine::WebGpu => r#"<meta name="topple-engine" content="webgpu">"#,
        }
    }

    /// What it reads before it asks for the first picture.
    fn data(self) -> &'static [&'static str] {
        match self {
            Engine::Server => &["about"],
            Engine::WebGpu => &["about.json", "model.json", "sweep.wgsl"],
        }
    }

    /// True of a module that a page with this engine runs.
    fn needs(self, path: &str) -> bool {
        match self {
            Engine::Server => !path.starts_with("gpu/"),
            Engine::WebGpu => path != "server.js",
        }
    }
}

/// The page with its engine, and with `more` lines in its head. It names the modules that it runs and what they read, so
/// that a browser asks for all of them at once instead of one after another as imports are read.
pub fn index(engine: Engine, more: &str) -> String {
    let modules = FILES.iter().filter(|file| file.kind == SCRIPT && engine.needs(file.path));
    let modules =
        modules.map(|file| format!("<link rel=\"modulepreload\" href=\"{}\">\n", file.path));
    // A fetch takes what was loaded ahead where both are of one kind, for which there is `crossorigin`.
    let data = engine.data().iter().map(|path| {
        format!("<link rel=\"preload\" as=\"fetch\" href=\"{path}\" crossorigin=\"anonymous\">\n")
    });
    let links: String = modules.chain(data).collect();
    let head = format!("{}\n{more}{links}", engine.line());
    let bytes = file(INDEX).map_or(&b""[..], |file| file.bytes);
    String::from_utf8_lossy(bytes).replacen(&format!("{NAMED}\n"), &head, 1)
}

/// The first file of a server's page.
static SERVED: LazyLock<String> = LazyLock::new(|| index(Engine::Server, ""));

/// A file as a server gives it: its type and its bytes.
pub fn served(path: &str) -> Option<(&'static str, &'static [u8])> {
    match path {
        "" | INDEX => Some((HTML, SERVED.as_bytes())),
        path => file(path).map(|file| (file.kind, file.bytes)),
    }
}

/// What a page may load: nothing from elsewhere.
pub const POLICY: &str = "default-src 'self'; img-src 'self' blob: data:; style-src 'self'; base-uri 'none'; \
                          form-action 'none'; frame-ancestors 'none'";

/// A file of the page by its path.
pub fn file(path: &str) -> Option<&'static File> {
    FILES.iter().find(|file| file.path == path)
}
