//! What a server has: its backends, its records and suites, and the views that are being computed.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::asked::{self, AskedPrecision, Flat};
use super::records::Records;
use super::refused::Refused;
use super::suites::Suites;
use topple::backend::request::{BackendRequest, OpenBackends};
use topple::model::precision::Precision;
use topple::scene::{Grid, Scene};
use topple::sweep::error::SweepError;
use topple::sweep::settings::{RunSettings, VerifySettings};

/// How a page's cells are computed.
#[derive(Debug, Clone)]
pub struct Settings {
    /// On what.
    pub backend: BackendRequest,
    /// GPUs by their numbers; empty: all of the best one's kind.
    pub adapters: Vec<usize>,
}

/// The newest view of a tab: its number, and the flag that ends it while it is computed.
type Newest = (u64, Option<Arc<AtomicBool>>);

/// Tabs whose last views are known; of more, those that rest are forgotten.
const TABS: usize = 256;

/// What a server has.
pub struct Session {
    settings: Settings,
    /// Its records.
    pub records: Records,
    /// Its suites.
    pub suites: Suites,
    /// The scene that the page begins with, and what it is called.
    pub first: Flat,
    opened: [Mutex<Option<Arc<OpenBackends>>>; 2],
    /// The newest view of each tab.
    views: Mutex<HashMap<String, Newest>>,
}

/// A scene that is ready to be swept.
pub struct Ready {
    /// The scene, checked.
    pub scene: Scene,
    /// Its cells.
    pub grid: Grid,
    /// How they are computed.
    pub settings: RunSettings,
    /// The backend that runs them.
    pub opened: Arc<OpenBackends>,
}

impl Session {
    /// A session on backends that are opened at once, so that what is wrong with them is told before a page is.
    pub fn open(settings: Settings, records: Records, first: Flat) -> Result<Session, SweepError> {
        let suites = Suites::default();
        let (opened, views) = (Default::default(), Mutex::default());
        let session = Session { settings, records, suites, first, opened, views };
        session.opened(Precision::F32)?;
        Ok(session)
    }

    /// The backends for a number type; the CPU where a GPU does not have f64.
    pub fn opened(&self, precision: Precision) -> Result<Arc<OpenBackends>, SweepError> {
        let place = &self.opened[usize::from(precision == Precision::F64)];
        // What is stored is whole, whoever panicked.
        let mut opened = place.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(opened) = &*opened {
            return Ok(Arc::clone(opened));
        }
        let Settings { backend, adapters } = &self.settings;
        let first = backend.open(precision, adapters);
        let found = match precision {
            Precision::F64 => first.or_else(|_| BackendRequest::Cpu.open(precision, &[])),
            Precision::F32 => first,
        };
        let found = Arc::new(found?);
        *opened = Some(Arc::clone(&found));
        Ok(found)
    }

    /// The scene of a request, ready.
    pub fn ready(
        &self,
        flat: &Flat,
        count: [u32; 2],
        precision: AskedPrecision,
    ) -> Result<Ready, Refused> {
        let scene = self.records.check(&asked::builder(flat, Some(count))?)?;
        let grid = Grid::of(&scene);
        let precision = precision.of(&grid);
        let settings = self.settings(precision);
        Ok(Ready { scene, grid, settings, opened: self.opened(precision)? })
    }

    /// The settings of a sweep that is neither saved nor verified.
    pub fn settings(&self, precision: Precision) -> RunSettings {
        let mut settings = RunSettings::default();
        settings.backend = self.settings.backend;
        settings.adapters.clone_from(&self.settings.adapters);
        settings.method.precision = precision;
        settings.verify = VerifySettings::cells(0);
        settings
    }

    /// Begins a view of a tab, and ends an older one; none where a newer one has begun. The flag ends it.
    pub fn begin(&self, tab: &str, view: u64) -> Option<Arc<AtomicBool>> {
        let mut views = self.views.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((known, stop)) = views.get(tab) {
            if *known > view {
                return None;
            }
            stop.iter().for_each(|stop| stop.store(true, Ordering::Relaxed));
        }
        if views.len() >= TABS {
            views.retain(|_, (_, stop)| stop.is_some());
        }
        let stop = Arc::new(AtomicBool::new(false));
        views.insert(tab.into(), (view, Some(Arc::clone(&stop))));
        Some(stop)
    }

    /// Ends all views.
    pub fn stop(&self) {
        let views = self.views.lock().unwrap_or_else(PoisonError::into_inner);
        let running = views.values().filter_map(|(_, stop)| stop.as_ref());
        running.for_each(|stop| stop.store(true, Ordering::Relaxed));
    }

    /// Hears that a view is over. Its number stays known: an older request may still be on its way.
    pub fn end(&self, tab: &str, view: u64) {
        let mut views = self.views.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, stop)) = views.get_mut(tab).filter(|(known, _)| *known == view) {
            *stop = None;
        }
    }
}
