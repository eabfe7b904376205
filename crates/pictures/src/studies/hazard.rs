//! The picture of a hazard curve: how often a year a level is exceeded.

use crate::colours::BLACK;
use crate::colours::palette::CURVES;
use crate::drawing::canvas::{Canvas, Place, Point, dashed, stroke};
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, LEFT};
use crate::drawing::picture::Picture;
use crate::drawing::swatch::Mark;
use crate::drawing::{COLUMN, MARGIN};

const HEIGHT: f64 = 110.0;

/// Draws points of a level and its annual rate, over an axis with a label; with a line at a rate, where one is
/// given. None of fewer than two points that logarithms have.
pub fn draw(points: &[[f64; 2]], label: &str, target: Option<f64>) -> Option<Picture> {
    let is_positive = |value: f64| value.is_finite() && value > 0.0;
    let mut points: Vec<[f64; 2]> = points.to_vec();
    points.retain(|point| point.iter().all(|value| is_positive(*value)));
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let ([low, _], [high, _]) = (*points.first()?, *points.last()?);
    if low >= high {
        return None;
    }
    let target = target.filter(|target| is_positive(*target));
    let rates = points.iter().map(|point| point[1]).chain(target);
    let (least, most) = rates.fold((f64::MAX, 0.0_f64), |(a, b), rate| (a.min(rate), b.max(rate)));
    let mut canvas = Canvas::new(COLUMN);
    let x = MARGIN + LEFT;
    let place = Place { x, y: MARGIN, width: canvas.inner() - x, height: HEIGHT };
    let y = Axis::log(0.7 * least, 1.4 * most, "exceeded, times a year");
    let frame = Frame::new(place, Axis::log(low, high, label), y);
    let at = |level: f64, rate: f64| -> Point { frame.at((level.log10(), rate.log10())) };
    let curve: Vec<Point> = points.iter().map(|[level, rate]| at(*level, *rate)).collect();
    canvas.clipped(place, |canvas| {
        if let Some(target) = target {
            canvas.line([at(low, target), at(high, target)], dashed(BLACK, 0.7, (3.2, 2.0)));
        }
        canvas.line(curve.iter().copied(), stroke(CURVES[0], 1.1));
    });
    frame.draw(&mut canvas, BOTH);
    for point in curve {
        Mark::Disc.draw(&mut canvas, point, 1.4, CURVES[0]);
    }
    Some(canvas.finish(place.bottom() + BELOW + MARGIN))
}
