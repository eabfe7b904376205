//! Motions in full contact, of which the bounds of each gap are kept. As many motions are integrated at once as a vector
//! has lanes.

use fearless_simd::Level;

use super::motions::Slots;
use super::sampling::{Gaps, load};
use super::shared_motion::MotionSet;
use super::written_motions::WrittenMotions;
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::{Lanes, Shared};
use crate::stepping::spans::{Direction, Spans};
use crate::work::vectors::vectorized;

/// Integrates motions on the vectors of a level, no more than it has [lanes](crate::work::vectors::lanes_of), and writes
/// them to their slots.
pub fn integrate<R: Real>(set: MotionSet<R>, slots: &mut [Slots<R>], level: Level) {
    let zero = R::of(0.0);
    vectorized!(level, zero => integrate_lanes(set, slots, zero));
}

#[inline(always)]
fn integrate_lanes<V: Vector>(
    set: MotionSet<V::Element>,
    slots: &mut [Slots<V::Element>],
    zero: V,
) {
    let MotionSet { variant, direction, record, starts } = set;
    let models: Vec<_> = starts.iter().map(|start| start.model).collect();
    let mut lanes = Lanes::new(Shared { variant, models: &models, record }, zero);
    let (forces, none) = (variant.asked.forces, direction.no_crest(zero));
    lanes.spans = Spans { direction: forces.then_some(direction), crest: none };
    load(&mut lanes, &set);
    let mut gaps = Gaps::at(force(&lanes, direction), direction);
    let first = gaps.end(zero.mask(0), &lanes, direction);
    let mut written = WrittenMotions::begin(slots, (direction, forces), &first);
    while lanes.running() != 0 {
        let ended = lanes.advance();
        let through = lanes.between_steps();
        gaps.take(through, force(&lanes, direction));
        // The gaps of a pulse are its steps.
        let over = if variant.recorded { through & lanes.between_segments() } else { through };
        if V::any(over) {
            let row = gaps.end(over, &lanes, direction);
            written.add(V::bits(over), &row);
            gaps.begin(over);
            lanes.spans.crest = V::select(over, none, lanes.spans.crest);
        }
        lanes.leave_off(ended);
    }
    written.end();
}

/// X or Y in each lane.
#[inline(always)]
fn force<V: Vector>(lanes: &Lanes<V>, direction: Direction) -> V {
    direction.of(lanes.contact())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::contact::motions::LOWER;
    use crate::cells::contact::shared_motion::Start;
    use crate::cells::plan::Plan;
    use crate::model::asked::Asked;
    use crate::model::isolation::Variant;
    use crate::scene::record::synthetic;
    use crate::scene::{Grid, Parameter, Range, Scene, SceneBuilder};
    use crate::work::vectors::lanes_of;

    /// The numbers of motions, quantity by quantity, with the contact forces or without them.
    fn numbers<R: Real>(set: MotionSet<R>, level: Level, forces: bool) -> Vec<Vec<Vec<R>>> {
        let fields = set.direction.fields(forces);
        let motion = |start: &Start<R>| vec![vec![R::of(0.0); start.samples()]; fields];
        let mut motions: Vec<Vec<Vec<R>>> = set.starts.iter().map(motion).collect();
        let slots = motions.iter_mut().map(|motion| motion.iter_mut().map(|of| &mut of[..]));
        let mut slots: Vec<Slots<R>> = slots.map(Iterator::collect).collect();
        let asked = Asked { forces, ..set.variant.asked };
        let set = MotionSet { variant: Variant { asked, ..set.variant }, ..set };
        integrate(set, &mut slots, level);
        motions
    }

    /// Lanes that have ended or that have no motion do not change the other lanes. Without contact forces what is kept is
    /// the same.
    fn each_is_what_it_is_alone<R: Real>(scene: &Scene, direction: Direction) {
        let plan = Plan::new(scene, 0.01).unwrap();
        let record = plan.record::<R>();
        let alone = match direction {
            Direction::Horizontal => plan.without_vertical(),
            Direction::Vertical => plan.without_horizontal(),
        };
        let recorded = scene.excitation.record().is_some();
        let (clock, after) = if recorded { (&alone, 0) } else { (&plan, 40) };
        let grid = Grid::of(scene);
        let cases = (0..grid.len().min(lanes_of::<R>(Level::new()))).map(|cell| grid.case(cell));
        let starts: Vec<Start<R>> =
            cases.map(|case| Start::of(clock, &case, direction, after)).collect();
        let variant = Variant { certificate: false, ..alone.variant() };
        let (record, level) = (&record[..], Level::new());
        let of = |starts, forces| {
            numbers(MotionSet { variant, direction, record, starts }, level, forces)
        };
        let [together, bounded] = [true, false].map(|forces| of(&starts, forces));
        assert_eq!(together.len(), starts.len());
        for (number, motion) in together.iter().enumerate() {
            let [lone] = &of(&starts[number..=number], true)[..] else { panic!("one motion") };
            assert_eq!(starts[number].after, after);
            assert!(motion == lone, "{direction:?} {number}");
            let bounded = &bounded[number];
            assert!(
                motion[..bounded.len()] == bounded[..],
                "{direction:?} {number} without forces"
            );
            let (gaps, beyond) = (motion[LOWER].len() - 1, R::of(-1.0e30));
            let is_shared = motion[LOWER][..gaps].iter().all(|lower| *lower > beyond);
            assert!(is_shared, "{direction:?} {number} is shared");
        }
    }

    /// Under pulses of many lengths the lanes end one after the other.
    #[test]
    fn motions_under_pulses_are_those_of_each_alone() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::AV, 2.0)
            .with(Parameter::AH, 5.0)
            .with(Parameter::Omega, Range::even(0.5, 12.0, 16))
            .check()
            .unwrap();
        for direction in [Direction::Horizontal, Direction::Vertical] {
            each_is_what_it_is_alone::<f32>(&scene, direction);
            each_is_what_it_is_alone::<f64>(&scene, direction);
        }
    }

    /// Stiff bases have many steps to a gap, and others few.
    #[test]
    fn motions_under_a_record_are_those_of_each_alone() {
        let scene = |parameter, from, to| {
            let other = if parameter == Parameter::TH { Parameter::TV } else { Parameter::TH };
            SceneBuilder::object(1)
                .with(parameter, Range::even(from, to, 15))
                .with(other, 1.0)
                .check_under_motion(synthetic::pair())
                .unwrap()
        };
        each_is_what_it_is_alone::<f32>(&scene(Parameter::TV, 0.03, 1.2), Direction::Vertical);
        each_is_what_it_is_alone::<f64>(&scene(Parameter::TV, 0.03, 1.2), Direction::Vertical);
        each_is_what_it_is_alone::<f32>(&scene(Parameter::TH, 0.3, 4.0), Direction::Horizontal);
        each_is_what_it_is_alone::<f64>(&scene(Parameter::TH, 0.3, 4.0), Direction::Horizontal);
    }
}
