use topple_pictures::drawing::MILLIMETRE;
use topple_pictures::drawing::canvas::{Canvas, Place, stroke};
use topple_pictures::drawing::raster::png;
use topple_pictures::drawing::text::style;

/// A canvas of 72 by 36 points is 300 by 150 pixels.
#[test]
fn marks_lie_where_they_are_drawn_and_are_cut_at_the_edge_of_their_place() {
    let mut canvas = Canvas::new(72.0);
    let place = |x, y, width, height| Place { x, y, width, height };
    canvas.fill(place(6.0, 6.0, 12.0, 12.0), [255, 0, 0]);
    canvas.fill_through(place(6.0, 12.0, 6.0, 6.0), [0, 0, 255], 0.5);
    canvas.disc((30.0, 12.0), 6.0, [0, 128, 0]);
    canvas.line([(40.0, 12.0), (60.0, 12.0)], stroke([0, 0, 0], 1.2));
    let image = png((2, 1), |column, _| [255 * column as u8, 0, 0, 255]).unwrap();
    canvas.image(place(6.0, 24.0, 12.0, 6.0), &image, true);
    canvas.clipped(place(24.0, 24.0, 6.0, 6.0), |canvas| {
        canvas.fill(place(0.0, 20.0, 72.0, 12.0), [9, 9, 9]);
    });
    let picture = canvas.finish(36.0);
    assert!((picture.points().0 - 72.0).abs() < 1e-9, "{:?}", picture.points());
    let pixels = picture.pixels(300.0).unwrap();
    assert_eq!((pixels.width(), pixels.height()), (300, 150));
    let at = |x: f64, y: f64| {
        let pixel = pixels.pixel((x * 300.0 / 72.0) as u32, (y * 300.0 / 72.0) as u32).unwrap();
        [pixel.red(), pixel.green(), pixel.blue()]
    };
    let white = [255, 255, 255];
    assert_eq!([at(15.0, 9.0), at(5.5, 9.0), at(18.5, 9.0)], [[255, 0, 0], white, white]);
    assert_eq!([at(9.0, 15.0), at(15.0, 15.0)], [[127, 0, 128], [255, 0, 0]]);
    assert_eq!([at(30.0, 7.0), at(35.5, 17.5)], [[0, 128, 0], white]);
    assert_eq!([at(50.0, 12.0), at(50.0, 13.0), at(61.0, 12.0)], [[0; 3], white, white]);
    assert_eq!([at(11.0, 27.0), at(13.0, 27.0)], [[0; 3], [255, 0, 0]]);
    assert_eq!([at(23.5, 27.0), at(27.0, 27.0), at(30.5, 27.0)], [white, [9; 3], white]);
}

/// Letters have their feet at their place; those of an upward text run up from it.
#[test]
fn letters_stand_at_their_place() {
    let extent = |style, text| {
        let mut canvas = Canvas::new(100.0 * MILLIMETRE);
        canvas.text((140.0, 140.0), style, text);
        let pixels = canvas.finish(100.0 * MILLIMETRE).pixels(72.0).unwrap();
        let width = pixels.width() as usize;
        let dark = pixels.pixels().iter().enumerate().filter(|(_, pixel)| pixel.red() < 128);
        let dark: Vec<(usize, usize)> = dark.map(|(at, _)| (at % width, at / width)).collect();
        let of = |side: fn(&(usize, usize)) -> usize| {
            let all = || dark.iter().map(side);
            (all().min().unwrap(), all().max().unwrap())
        };
        (of(|at| at.0), of(|at| at.1))
    };
    let near = |place: (usize, usize), wanted: (usize, usize)| {
        place.0.abs_diff(wanted.0) <= 3 && place.1.abs_diff(wanted.1) <= 3
    };
    // An H of 40 points is some 28 high; the middle of HH is between them.
    let (across, down) = extent(style(40.0), "HH");
    assert!(near(down, (112, 139)) && near(across, (143, 193)), "{across:?} {down:?}");
    let (across, down) = extent(style(40.0).end(), "HH");
    assert!(near(down, (112, 139)) && near(across, (88, 136)), "{across:?} {down:?}");
    let (across, down) = extent(style(40.0).middle().upwards(), "HH");
    assert!(near(across, (112, 139)) && near(down, (115, 165)), "{across:?} {down:?}");
    // An index is below the line.
    assert!(extent(style(40.0), "T_h").1.1 > 143);
}
