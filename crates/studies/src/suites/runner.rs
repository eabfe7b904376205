//! Sweeps under the motions of a suite, several at a time: while the last cells of one are run, the next begins.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::gather::gather;
use super::saved;
use super::swept::SuiteJob;
use super::swept_motion::SweptMotion;
use super::verified::Verified;
use super::wanted::WantedMotion;
use crate::several::OneOfSeveral;
use topple::backend::backend_error::BackendError;
use topple::backend::ready::Backend;
use topple::scene::{Excitation, Parameter, Scene, SceneError, Values};
use topple::sweep::error::SweepError;
use topple::sweep::run::sweep_on;
use topple::sweep::verification;
use topple::work::observer::Observer;
use topple::work::threads::Threads;

/// Motions that are swept at a time on the CPU. Its cores share each; a second one fills them while the first
/// comes to its end.
const AT_A_TIME: usize = 2;
/// Cells of a sweep to which levels are put together: enough to fill vectors, few enough for the motions that
/// they share in full contact.
const TOGETHER: usize = 4096;

/// A motion that took no longer is run again when a run goes on: a file takes about as long to be written.
const WORTH_SAVING: Duration = Duration::from_millis(50);

/// Time beyond which the reference is not held: a year.
const LONGEST: Duration = Duration::from_secs(365 * 24 * 3600);

/// Runs a suite's motions.
pub(super) struct Runner<'a> {
    job: &'a SuiteJob,
    range: Range<usize>,
    observer: &'a dyn Observer,
    /// The next motion to begin.
    next: AtomicUsize,
    /// Set by the first error.
    stopped: AtomicBool,
    /// Cells that are saved.
    saved: AtomicUsize,
    /// Nanoseconds of the reference, of all workers together.
    verifying: AtomicU64,
}

/// What became of the motions.
pub(super) struct Swept {
    pub(super) motions: Vec<SweptMotion>,
    /// Those that an earlier run had saved.
    pub(super) resumed: usize,
    /// Seconds that the reference took of the time of all.
    pub(super) verifying: f64,
}

/// A motion's cells, run now or by an earlier run.
struct Done {
    motion: SweptMotion,
    resumed: bool,
}

impl<'a> Runner<'a> {
    pub(super) fn new(
        job: &'a SuiteJob,
        range: Range<usize>,
        observer: &'a dyn Observer,
    ) -> Runner<'a> {
        let (next, stopped) = (AtomicUsize::new(range.start), AtomicBool::new(false));
        let (saved, verifying) = (AtomicUsize::new(0), AtomicU64::new(0));
        Runner { job, range, observer, next, stopped, saved, verifying }
    }

    /// Runs the motions.
    pub(super) fn run(&self) -> Result<Swept, SweepError> {
        let workers = self.workers();
        let count = self.range.len();
        let done: Vec<Mutex<Option<Done>>> = (0..count).map(|_| Mutex::new(None)).collect();
        let (first_error, threads) = (Mutex::new(None), Threads::current());
        thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(|| {
                    threads.scope(|| {
                        while let Some(number) = self.take() {
                            match self.motion(number) {
                                Ok(motion) => {
                                    let place = &done[number - self.range.start];
                                    // What is stored is whole, whoever panicked.
                                    *place.lock().unwrap_or_else(PoisonError::into_inner) =
                                        Some(motion);
                                }
                                Err(error) => {
                                    self.stopped.store(true, Ordering::Relaxed);
                                    let mut first =
                                        first_error.lock().unwrap_or_else(PoisonError::into_inner);
                                    first.get_or_insert(error);
                                }
                            }
                        }
                    })
                });
            }
        });
        if let Some(error) = first_error.into_inner().unwrap_or_else(PoisonError::into_inner) {
            let (saved, all) = (self.saved.load(Ordering::Relaxed), self.job.cells());
            return Err(match &self.job.settings.saving {
                Some(folder) if saved > 0 => error.stopped(saved, all, folder),
                _ => error,
            });
        }
        let verifying = Duration::from_nanos(self.verifying.load(Ordering::Relaxed));
        let verifying = verifying.as_secs_f64() / workers as f64;
        let mut swept = Swept { motions: Vec::with_capacity(count), resumed: 0, verifying };
        let all =
            done.into_iter().map(|one| one.into_inner().unwrap_or_else(PoisonError::into_inner));
        for Done { motion, resumed } in all.flatten() {
            swept.motions.push(motion);
            swept.resumed += usize::from(resumed);
        }
        Ok(swept)
    }

    /// Motions that are swept at a time.
    fn workers(&self) -> usize {
        match self.job.opened.backends[0] {
            Backend::Cpu => AT_A_TIME,
            _ => 1,
        }
    }

    fn take(&self) -> Option<usize> {
        if self.stopped.load(Ordering::Relaxed) {
            return None;
        }
        Some(self.next.fetch_add(1, Ordering::Relaxed)).filter(|next| self.range.contains(next))
    }

    /// A motion at all its levels, or what is saved of it.
    fn motion(&self, number: usize) -> Result<Done, SweepError> {
        let SuiteJob { grid, all, settings, opened, .. } = self.job;
        let (wanted, scene) = &all[number];
        let cells = grid.len();
        let place = settings.saving.as_ref().map(|folder| {
            let tag = saved::tag(wanted, scene, &opened.backends[0], settings)?;
            Ok::<_, SweepError>((folder, tag))
        });
        let place = place.transpose()?;
        if let Some((folder, tag)) = &place
            && let Some(motion) = saved::load(folder, tag, wanted, (cells, settings.others.len()))
        {
            let runs = if settings.run.method.resolve { 2 } else { 1 };
            self.observer.advance(runs * motion.outcomes.len());
            self.saved.fetch_add(motion.outcomes.len(), Ordering::Relaxed);
            return Ok(Done { motion, resumed: true });
        }
        let mut motion = SweptMotion {
            id: wanted.id.clone(),
            weight: wanted.weight,
            outcomes: Vec::new(),
            max_u: Vec::new(),
            stroke_v: Vec::new(),
            zeta: Vec::new(),
            others: vec![Vec::new(); settings.others.len()],
            verified: Verified::default(),
        };
        let began = Instant::now();
        let together = (TOGETHER / cells).max(1);
        // The sample is spread over all motions, and the levels of each.
        let share = |cells: usize, k: usize, of: usize| cells * (k + 1) / of - cells * k / of;
        let sampled = share(settings.run.verify.cells, number, all.len());
        let sweeps = wanted.factors.len().div_ceil(together);
        for (k, factors) in wanted.factors.chunks(together).enumerate() {
            self.levels(scene, wanted, factors, share(sampled, k, sweeps), &mut motion)?;
        }
        if let Some((folder, tag)) = &place
            && (settings.shard.is_some() || began.elapsed() >= WORTH_SAVING)
        {
            saved::save(folder, tag, &motion)?;
            self.saved.fetch_add(motion.outcomes.len(), Ordering::Relaxed);
        }
        Ok(Done { motion, resumed: false })
    }

    /// Adds the cells at some levels to a motion's.
    fn levels(
        &self,
        scene: &Scene,
        wanted: &WantedMotion,
        factors: &[f64],
        sampled: usize,
        motion: &mut SweptMotion,
    ) -> Result<(), SweepError> {
        let settings = self.job.sweep_settings();
        let (mut axes, mut scene) = (Vec::new(), scene.clone());
        let scales: Vec<f64> = factors.iter().map(|factor| factor * wanted.pair.factor).collect();
        if scales != [1.0] {
            // The factor of a peak is in these, and the samples are not scaled yet.
            scene.numbers.remove(Parameter::Pga);
            scene.excitation = Excitation::Record(wanted.ground.clone());
            let values = Values::list(scales)
                .map_err(|error| SceneError { key: "levels", problem: error.to_string() })?;
            axes.push((Parameter::Scale, values));
        }
        let watch = OneOfSeveral::of(self.observer, Some(&self.stopped));
        let map = sweep_on(&self.job.opened, &scene, &axes, &settings, &watch)?;
        let others = &self.job.settings.others;
        gather(&map, &self.job.grid, factors.len(), others, motion)?;
        if sampled == 0 || map.by_reference() {
            return Ok(());
        }
        let began = Instant::now();
        // The time that they may take is that of all workers.
        let all = self.job.settings.run.verify.within.min(LONGEST) * self.workers() as u32;
        let spent = Duration::from_nanos(self.verifying.load(Ordering::Relaxed));
        let chosen = map.choose(sampled, &watch)?;
        let within = (&chosen[..], all.saturating_sub(spent));
        let verification =
            verification::verify((&map.plan, map.method.columns), &map.grid, within, &watch);
        let verification = verification.ok_or(BackendError::Cancelled)?;
        let keys: Vec<&str> = map.grid.axes().iter().map(|axis| axis.key()).collect();
        motion.verified.add(&Verified::of(&wanted.id, &keys, &verification));
        // Centuries fit.
        let took = began.elapsed().as_nanos() as u64;
        self.verifying.fetch_add(took, Ordering::Relaxed);
        Ok(())
    }
}
