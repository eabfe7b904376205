//! The block on its base: the block to scale, what carries it as symbols.

use topple::scene::parameters::{Entry, Section};
use topple::scene::record::rounded;
use topple::scene::{Case, Device, Grid, Parameter, Scene};
use topple_pictures::colours::BLACK;
use topple_pictures::drawing::canvas::{Canvas, Place, dashed, stroke};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::shapes::spring;
use topple_pictures::drawing::share::percent;
use topple_pictures::drawing::text::{MIDDLE, style};
use topple_pictures::drawing::{COLUMN, FONT};

use super::tables::number;

/// Largest width and height of the block, points.
const MOST: (f64, f64) = (120.0, 170.0);
/// Left and right of the block room for the dimensions, above it for the width's.
const ABOVE: f64 = 42.0;
/// Heights of a plate, of rollers and of springs.
const PLATE: f64 = 7.0;
const ROLLER: f64 = 13.0;
const SPRING: f64 = 20.0;
const STONE: [u8; 3] = [0xe4, 0xdf, 0xd4];
const STEEL: [u8; 3] = [0xa9, 0xb4, 0xc0];

/// The numbers of a scene's first cell; none of a block that no scene has.
pub fn case(scene: &Scene) -> Option<Case> {
    let case = Grid::of(scene).case(0);
    let is_length = |length: f64| length.is_finite() && length > 0.0;
    let block = &case.block;
    let stands = block.offset().is_finite() && block.offset().abs() < block.half_width;
    (is_length(block.half_width) && is_length(block.height) && stands).then_some(case)
}

/// Draws the block of a scene's first cell on its base.
pub fn draw(scene: &Scene, case: &Case) -> Picture {
    let (block, base) = (&case.block, &case.isolation);
    let scale = (MOST.0 / (2.0 * block.half_width)).min(MOST.1 / (2.0 * block.height));
    let (wide, high) = (2.0 * block.half_width * scale, 2.0 * block.height * scale);
    let mut canvas = Canvas::new(COLUMN);
    let thin = stroke(BLACK, 0.5);
    let line = stroke(BLACK, 0.8);
    let middle = 0.5 * COLUMN - 10.0;
    let (left, right, top) = (middle - 0.5 * wide, middle + 0.5 * wide, ABOVE);
    let foot = top + high;
    let body = Place { x: left, y: top, width: wide, height: high };
    canvas.fill(body, STONE);
    canvas.outline(body, line);
    let centre = (middle + block.offset() * scale, foot - block.height * scale);
    canvas.line([(middle, top), (middle, foot)], dashed(BLACK, 0.4, (3.0, 2.0)));
    canvas.disc(centre, 2.2, BLACK);
    canvas.text((centre.0 + 4.0, centre.1 - 3.0), style(FONT), "C");
    // Between ends, a dimension and its name.
    let across = |canvas: &mut Canvas, y: f64, (from, to): (f64, f64), text: &str| {
        canvas.line([(from, y), (to, y)], thin);
        for x in [from, to] {
            canvas.line([(x, y - 2.5), (x, y + 2.5)], thin);
        }
        canvas.text((0.5 * (from + to), y - 4.0), style(FONT).middle(), text);
    };
    across(&mut canvas, top - 20.0, (left, right), &metres("2B", 2.0 * block.half_width));
    if block.offset() != 0.0 {
        let (ends, y) = ((middle, centre.0), top - 7.0);
        canvas.line([centre, (centre.0, y - 2.5)], dashed(BLACK, 0.3, (1.5, 1.5)));
        canvas.line([(middle, top), (middle, y - 2.5)], thin);
        canvas.line([(ends.0, y), (ends.1, y)], stroke(BLACK, 0.9));
        let name = metres("e", block.offset().abs());
        canvas.text((right + 4.0, y + MIDDLE * FONT), style(FONT), &name);
    }
    let x = right + 12.0;
    canvas.line([(x, centre.1), (x, foot)], thin);
    for y in [centre.1, foot] {
        canvas.line([(x - 2.5, y), (x + 2.5, y)], thin);
    }
    canvas.line([(centre.0 + 3.0, centre.1), (x, centre.1)], dashed(BLACK, 0.3, (1.5, 1.5)));
    let place = (x + 5.0, 0.5 * (centre.1 + foot) + MIDDLE * FONT);
    canvas.text(place, style(FONT), &metres("H", block.height));
    if let Some(mass) = given(scene, Parameter::Mass) {
        canvas.text((place.0, place.1 + 1.3 * FONT), style(FONT), &mass);
    }
    let mut y = foot;
    let wider = 12.0;
    let plate = |canvas: &mut Canvas, y: f64, text: String| {
        let place = Place { x: left - wider, y, width: wide + 2.0 * wider, height: PLATE };
        canvas.fill(place, STEEL);
        canvas.outline(place, stroke(BLACK, 0.6));
        canvas.text((place.right() + 4.0, y + 0.5 * PLATE + MIDDLE * FONT), style(FONT), &text);
    };
    let beside = |canvas: &mut Canvas, y: f64, text: String| {
        canvas.text((right + wider + 4.0, y + MIDDLE * FONT), style(FONT), &text);
    };
    if let Some(vertical) = &base.vertical {
        plate(&mut canvas, y, format!("m_v = {} kg", short(base.plate_v)));
        y += PLATE;
        for x in [left, right] {
            canvas.line(spring((x, y), (x, y + SPRING), 6, 4.0), line);
        }
        beside(&mut canvas, y + 0.5 * SPRING, format!("T_v = {} s", short(vertical.t_v)));
        y += SPRING;
    }
    if base.horizontal.is_some() {
        // Without a vertical isolation both plates move as one.
        let plates = match base.vertical {
            Some(_) => format!("m_h = {} kg", short(base.plate_h)),
            None => format!("m_h + m_v = {} kg", short(base.plate_h + base.plate_v)),
        };
        plate(&mut canvas, y, plates);
        y += PLATE;
        let words = moves(scene, case);
        // As high as the words beside it.
        let step = 1.3 * FONT;
        let height = ROLLER.max(step * words.len() as f64);
        let carried = Place { x: left, y, width: wide, height };
        device(&mut canvas, Device::of(&scene.numbers), carried);
        let first = y + 0.5 * (height - step * (words.len() as f64 - 1.0));
        for (number, text) in words.into_iter().enumerate() {
            beside(&mut canvas, first + step * number as f64, text);
        }
        y += height;
    }
    let (from, to) = (left - 2.5 * wider, right + 2.5 * wider);
    canvas.line([(from, y), (to, y)], stroke(BLACK, 1.0));
    let mut x = from;
    while x < to - 4.0 {
        canvas.line([(x, y + 5.0), (x + 5.0, y)], stroke(BLACK, 0.4));
        x += 6.0;
    }
    let below = y + 8.0 + FONT;
    let words = "the ground, which moves as the motion says";
    canvas.text((middle, below), style(FONT).middle(), words);
    canvas.finish(below + 6.0)
}

/// A device of the horizontal direction as a symbol: rollers of the paper's base, layers of a bearing, a slider in the dish of a
/// pendulum.
fn device(canvas: &mut Canvas, device: Device, place: Place) {
    let line = stroke(BLACK, 0.8);
    let Place { x, y, width, height } = place;
    let middle = x + 0.5 * width;
    match device {
        Device::Paper => {
            for x in [x, middle, place.right()] {
                canvas.ring((x, y + 0.5 * height), 0.5 * height - 0.4, line);
            }
        }
        Device::Bilinear => {
            let wide = 0.25 * width;
            for x in [x, place.right() - wide] {
                canvas.outline(Place { x, y, width: wide, height }, line);
                for layer in 1..4 {
                    let y = y + height * f64::from(layer) / 4.0;
                    canvas.line([(x, y), (x + wide, y)], stroke(BLACK, 0.5));
                }
            }
        }
        Device::Pendulum => {
            let dish = |x: f64| {
                let across = (x - middle) / (0.5 * width);
                (x, y + height * (0.85 - 0.45 * across * across))
            };
            let points = (0..=24).map(|k| dish(x + width * f64::from(k) / 24.0));
            canvas.line(points, line);
            let slider = 0.06 * width;
            let (left, right) = (middle - slider, middle + slider);
            let foot = dish(middle).1;
            canvas.polygon([(left, y), (right, y), (right, foot), (left, foot)], STEEL);
            canvas.line([(left, y), (left, foot), (right, foot), (right, y)], stroke(BLACK, 0.6));
        }
    }
}

/// The first value of a number that a scene has, with its symbol and its unit.
fn given(scene: &Scene, one: Parameter) -> Option<String> {
    let value = scene.numbers.get(one)?.iter().next()?;
    Some(one.entry().written(rounded(value, 4)))
}

/// What the device of the horizontal direction is known by: its catalogue's numbers, where it has some, and its periods.
fn moves(scene: &Scene, case: &Case) -> Vec<String> {
    let Some(law) = &case.isolation.horizontal else { return Vec::new() };
    let after = law.t_h / law.psi.sqrt();
    let after = |what: &str| match after.is_finite() {
        true => format!("T = {} s {what}", short(after)),
        false => format!("no period {what}"),
    };
    let t_h = format!("T_h = {} s", short(law.t_h));
    let (numbers, periods): (&[Parameter], Vec<String>) = match Device::of(&scene.numbers) {
        Device::Paper => (&[], vec![t_h]),
        Device::Pendulum => (&[Parameter::Radius, Parameter::Mu], vec![after("sliding")]),
        Device::Bilinear => {
            (&[Parameter::K1, Parameter::K2, Parameter::Qd], vec![t_h, after("yielded")])
        }
    };
    numbers.iter().filter_map(|one| given(scene, *one)).chain(periods).collect()
}

fn metres(name: &str, value: f64) -> String {
    format!("{name} = {} m", short(value))
}

fn short(value: f64) -> String {
    rounded(value, 4).to_string()
}

/// What the pictures show, and what of them is not to scale.
pub const SHOWN: &str = "The block is drawn to scale; the plates, springs and devices of the base are symbols. B is half the width, H the height of the \
    centre of mass C above the base, M the mass where it is known: a block of even density is twice as high, as drawn.";

/// What a picture shows beside that.
pub fn caption(scene: &Scene, case: &Case) -> String {
    let mut text = String::new();
    if case.block.offset() != 0.0 {
        let side = if case.block.offset() > 0.0 { "right" } else { "left" };
        text += &format!(" C lies to the {side} of the middle by e.");
    }
    text += match (case.isolation.horizontal.is_some(), case.isolation.vertical.is_some()) {
        (true, true) => {
            " The base moves horizontally on the ground, and the upper plate vertically (T_v) on springs."
        }
        (true, false) => " The base moves horizontally on the ground, not vertically.",
        (false, true) => " The plate moves vertically (T_v) on springs, not horizontally.",
        (false, false) => " The block stands on the ground itself.",
    };
    if let Some(law) = &case.isolation.horizontal {
        text += &match Device::of(&scene.numbers) {
            Device::Paper => format!(
                " T_h = {} s is the period of small horizontal motions; after yielding the base has {} of that stiffness.",
                short(law.t_h),
                percent(law.psi)
            ),
            Device::Pendulum => " It is a friction pendulum: R_d is the radius of its dish, μ its friction; T is its period when it slides."
                .into(),
            Device::Bilinear => " It is a bearing with two stiffnesses: T_h is its period before it yields, T that after yielding.".into(),
        };
    }
    // The drawing shows nothing of the ground's motion.
    let drawn = |entry: &Entry| matches!(entry.section, Section::Block | Section::Base);
    let swept = scene.swept().into_iter().map(Parameter::entry).filter(|entry| drawn(entry));
    let first = swept.filter_map(|entry| {
        let value = scene.numbers.get(entry.parameter)?.iter().next()?;
        Some(entry.written(number(value)))
    });
    let first: Vec<String> = first.collect();
    if !first.is_empty() {
        text += &format!(" Drawn for the first values: {}.", first.join(", "));
    }
    text
}
