//! The threads that compute on the CPU: those of the process, or as many as a call asks for.
//!
//! A call works under [`Threads::scope`]. Threads that it starts take its [`Threads::current`] with them, and what computes
//! on all threads does it by [`install`].

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Most threads that a call may ask for: more than a machine has cores, and few enough for the system to make at once.
pub const MOST: usize = 4096;

/// What is wrong with a number of threads; none where the number is valid.
pub fn too_many(count: NonZeroUsize) -> Option<String> {
    let problem = || {
        format!("{count} is too many; give no more than the machine has cores, and {MOST} at most")
    };
    (count.get() > MOST).then(problem)
}

thread_local! {
    /// The threads of the call that this thread works for.
    static CURRENT: RefCell<Threads> = const { RefCell::new(Threads(None)) };
}

/// Threads that compute; by default those of the process.
#[derive(Debug, Clone, Default)]
pub struct Threads(Option<Arc<ThreadPool>>);

impl Threads {
    /// A pool of `count` threads; the threads of the process where no number is given.
    ///
    /// # Errors
    /// More threads than the system gives.
    pub fn new(count: Option<NonZeroUsize>) -> Result<Threads, ThreadPoolBuildError> {
        let own = |count: NonZeroUsize| ThreadPoolBuilder::new().num_threads(count.get()).build();
        Ok(Threads(count.map(own).transpose()?.map(Arc::new)))
    }

    /// The threads of the call that this thread works for.
    pub fn current() -> Threads {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Runs work for a call that has these threads.
    pub fn scope<T>(&self, work: impl FnOnce() -> T) -> T {
        /// Puts back what was there, whoever panics.
        struct Before(Threads);
        impl Drop for Before {
            fn drop(&mut self) {
                CURRENT.set(std::mem::take(&mut self.0));
            }
        }
        let _before = Before(CURRENT.replace(self.clone()));
        work()
    }
}

/// Computes on the threads of the call that this thread works for. `work` waits for nothing but its own parts: where
/// there is one thread, it has it.
pub fn install<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match Threads::current().0 {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    #[test]
    fn a_call_computes_on_its_own_threads() {
        let count = || install(rayon::current_num_threads);
        let all = count();
        for wanted in [1, 3] {
            let threads = Threads::new(NonZeroUsize::new(wanted)).unwrap();
            threads.scope(|| {
                assert_eq!(count(), wanted);
                let current = Threads::current();
                let of_another = || thread::scope(|scope| scope.spawn(count).join().unwrap());
                assert_eq!(of_another(), all);
                let taken_along =
                    thread::scope(|scope| scope.spawn(|| current.scope(count)).join().unwrap());
                assert_eq!(taken_along, wanted);
            });
            assert_eq!(count(), all);
        }
    }
}
