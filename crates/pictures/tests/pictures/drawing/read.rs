use topple_pictures::drawing::canvas::{Canvas, Place, dashed, stroke};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::raster::png;
use topple_pictures::drawing::text::style;

/// A picture with all kinds of marks.
fn picture() -> Picture {
    let mut canvas = Canvas::new(144.0);
    let place = Place { x: 4.004, y: 20.0, width: 30.128, height: 12.0 };
    canvas.fill(place, [1, 2, 3]);
    canvas.fill_through(place, [200, 100, 0], 0.85);
    canvas.outline(place, stroke([0, 0, 0], 0.5));
    canvas.line([(3.0, 4.0), (-0.001, 5.0), (6.0, 7.25)], dashed([9, 9, 9], 0.5, (2.0, 1.5)));
    canvas.polygon_through([(50.0, 20.0), (60.0, 20.0), (55.0, 29.0)], [0, 128, 0], 0.5);
    canvas.disc((70.0, 25.0), 3.0, [0, 0, 255]);
    canvas.ring((80.0, 25.0), 3.0, stroke([255, 0, 0], 0.4));
    canvas.image(place, &png((2, 2), |x, y| [x as u8, y as u8, 0, 255]).unwrap(), true);
    canvas.clipped(place, |canvas| {
        canvas.image(place, &png((1, 1), |_, _| [1, 1, 1, 9]).unwrap(), false);
        canvas.clipped(place, |canvas| canvas.disc((20.0, 25.0), 9.0, [7, 7, 7]));
    });
    canvas.text((4.0, 10.0), style(7.0), "T_h = 2 s, v\u{308}_g, 10^{-3} & \"<b>'s\" AT_h AVAT");
    canvas.text((140.0, 60.0), style(8.0).end(), "a\u{a0}b &amp; ω_v²");
    canvas.text((100.0, 40.0), style(7.0).middle().upwards(), "u [m]");
    canvas.finish(72.0)
}

#[test]
fn a_picture_is_read_from_its_svg_with_text_or_with_outlines() {
    let picture = picture();
    for svg in [picture.svg(), picture.outlined()] {
        let read = Picture::of_svg(&svg).unwrap();
        assert_eq!(read.svg(), svg);
    }
    assert_eq!(picture.svg().matches("<text").count(), 3);
    assert_eq!(picture.outlined().matches("<text").count(), 0);
}

/// The outlines of letters lie where the letters do.
#[test]
fn outlines_look_as_text_does() {
    let picture = picture();
    let outlined = Picture::of_svg(&picture.outlined()).unwrap();
    let [text, outlines] = [&picture, &outlined].map(|picture| picture.frame().unwrap());
    assert_eq!((text.width(), text.height()), (300, 150));
    let pixels = || text.data().iter().zip(outlines.data());
    let apart = pixels().filter(|(a, b)| a.abs_diff(**b) > 32).count();
    assert!(apart * 1000 < text.data().len(), "{apart}");
}

#[test]
fn what_is_not_as_it_was_written_is_no_picture() {
    let svg = picture().svg();
    let (script, link) = ("<script>alert(1)</script>\n</svg>", "href=\"https://a.b/c.png\"/>");
    let embedded = svg.split("href=").nth(1).unwrap().split_once("/>").unwrap().0;
    let changed = [
        svg.replace("</svg>", script),
        svg.replace(&format!("href={embedded}/>"), link),
        svg.replace("<circle ", "<circle onclick=\"a()\" "),
        svg.replace("<rect width", "<rect  width"),
        svg.replace("</svg>\n", ""),
        svg.replace("T<tspan", "<a>T</a><tspan"),
        svg.replace("viewBox=\"0 0 144 ", "viewBox=\"0 0 0 "),
        svg.replace("cx=\"70\"", "cx=\"NaN\""),
        svg.replace("r=\"3\"", "r=\"inf\""),
        "<svg/>".into(),
        String::new(),
    ];
    for changed in changed {
        assert!(changed != svg && Picture::of_svg(&changed).is_none(), "{changed}");
    }
}
