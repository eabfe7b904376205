//! The samples of a record in the number types of sweeps: they are converted once, and shared by all batches of a sweep.

use std::sync::Arc;

use super::cache::Cache;
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::scene::record::Pair;

/// The horizontal and the vertical samples as they were read.
#[derive(Debug)]
struct Components([Arc<[f64]>; 2]);

/// By their places in memory: the samples are many.
impl PartialEq for Components {
    fn eq(&self, other: &Components) -> bool {
        self.0.iter().zip(&other.0).all(|(one, other)| Arc::ptr_eq(one, other))
    }
}

/// The samples of one record, in each number type that was needed.
#[derive(Debug, Default)]
pub(crate) struct Samples(Cache<Components>);

impl Samples {
    /// The samples of a record.
    pub(crate) fn of<R: Real>(&self, pair: &Pair) -> Arc<Vec<Ground<R>>> {
        let key = Components([&pair.horizontal, &pair.vertical].map(Arc::clone));
        // The scene of a plan is public: its record may be another one by now.
        self.0.keep(&key);
        if let Some(samples) = self.0.find(&key) {
            return samples;
        }
        // Two threads that begin at the same time convert the same samples twice.
        let both = pair.horizontal.iter().zip(pair.vertical.iter());
        let samples = both.map(|(h, v)| Ground { h: R::of(*h), v: R::of(*v) });
        let samples: Arc<Vec<Ground<R>>> = Arc::new(samples.collect());
        self.0.put(key, Arc::clone(&samples));
        samples
    }

    /// Frees all samples.
    pub(crate) fn clear(&self) {
        self.0.clear();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::cells::plan::Plan;
    use crate::scene::record::synthetic;
    use crate::scene::{Excitation, Parameter, SceneBuilder};

    /// Each number type has its samples once, also in the plans that are made from one; another record has its own.
    #[test]
    fn samples_are_converted_once() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 2.0)
            .with(Parameter::TV, 1.0)
            .check_under(Excitation::Record(synthetic::pair()))
            .unwrap();
        let mut plan = Plan::new(&scene, 0.01).unwrap();
        let (single, double) = (plan.record::<f32>(), plan.record::<f64>());
        assert!(Arc::ptr_eq(&single, &plan.full_model().halved().record()));
        assert!(Arc::ptr_eq(&double, &plan.without_vertical().record()));
        let pair = scene.excitation.record().unwrap();
        assert!(double.iter().zip(&pair.horizontal[..]).all(|(ground, h)| ground.h == *h));
        assert!(single.iter().zip(&pair.vertical[..]).all(|(ground, v)| ground.v == *v as f32));
        let mut other = pair.clone();
        other.horizontal = other.horizontal.iter().map(|h| 2.0 * h).collect();
        plan.scene.excitation = Excitation::Record(other);
        assert_eq!(plan.record::<f64>()[100].h, 2.0 * double[100].h);
    }
}
