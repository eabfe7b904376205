//! A view under a suite: how likely a block overturns, and where a base keeps within its limits.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::asked::builder;
use super::frame::frame;
use super::refused::Refused;
use super::session::{Ready, Session};
use super::stage::{StageSummary, ViewRequest, header};
use super::stages::at_most;
use super::watched::Watched;
use topple::results::values::ColumnValues;
use topple::scene::Grid;
use topple_studies::suites::envelope::{CellEnvelope, Envelope, EnvelopeSettings};
use topple_studies::suites::request::SuiteRequest;

/// Cells along an axis of the coarse and of the fine picture of a suite.
const COUNTS: [(&str, u32); 2] = [("coarse", 13), ("fine", FINEST)];
/// Cells along an axis of the finest picture of a suite.
pub const FINEST: u32 = 49;

/// Computes a view of a scene under a suite: `send` and `tell` are handed frames as those of [`super::view::run`] are.
pub fn run(
    session: &Session,
    request: &ViewRequest,
    id: &str,
    stop: &AtomicBool,
    send: impl Fn(Vec<u8>) -> bool,
    tell: &(dyn Fn(Vec<u8>) + Sync),
) -> Result<(), Refused> {
    let suite = session.suites.get(id)?;
    let limits = request.limits.read()?;
    let mut before = None;
    for (stage, most) in COUNTS {
        let count = at_most(&request.scene, request.count, most)?;
        if before.replace(count) == Some(count) {
            break;
        }
        let scene = builder(&request.scene, Some(count))?;
        let mut asked = SuiteRequest::new(scene);
        asked.check_envelope(&limits)?;
        let motions = asked.motions(&suite)?;
        if let Some(first) = motions.first() {
            let grid = Grid::of(&first.under(&asked.scene)?);
            asked.settings.run = session.settings(request.precision.of(&grid));
        }
        let job = asked.open_under(motions)?;
        let method = asked.settings.run.method;
        let began = Instant::now();
        let cells = job.cells();
        let ready = Ready {
            scene: job.scene.clone(),
            grid: job.grid.clone(),
            settings: asked.settings.run.clone(),
            opened: session.opened(method.precision)?,
        };
        let swept = job.run(&Watched::new(stage, stop, tell))?;
        let envelope = Envelope::of(swept, EnvelopeSettings::of(limits));
        let seconds = Some(began.elapsed().as_secs_f64());
        let told = StageSummary { stage, cells, seconds, note: "" };
        if !send(frame(header(&envelope.sweep.grid, &ready, &told), &arrays(&envelope))) {
            return Ok(());
        }
    }
    Ok(())
}

/// The arrays of a suite's view.
fn arrays(envelope: &Envelope) -> Vec<(&'static str, ColumnValues)> {
    let of = |one: fn(&CellEnvelope) -> f64| {
        ColumnValues::Singles(envelope.cells.iter().map(|cell| one(cell) as f32).collect())
    };
    vec![
        ("standing", of(|cell| cell.standing)),
        ("overturned", of(|cell| cell.overturned)),
        ("rocked", of(|cell| cell.rocked)),
        ("max_u", of(|cell| cell.max_u[2])),
        ("stroke_v", of(|cell| cell.stroke_v[2])),
        ("feasible", {
            ColumnValues::Codes(envelope.cells.iter().map(|cell| u8::from(cell.feasible)).collect())
        }),
    ]
}
