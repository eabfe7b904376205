use topple_pictures::map::refined::Outlines;

/// Draws outlines again by the even-odd rule: along a row each vertical piece left of a cell counts.
fn filled(paths: &[(u8, String)], (columns, rows): (usize, usize)) -> Vec<Vec<Option<u8>>> {
    let mut cells = vec![vec![None; columns]; rows];
    for (kind, data) in paths {
        let mut crossings = vec![vec![0; columns + 1]; rows];
        for outline in data.split('Z').filter(|outline| !outline.is_empty()) {
            let text = outline.replace('H', " H ").replace('V', " V ").replace('M', "");
            let words: Vec<&str> = text.split_whitespace().collect();
            let (x, y): (usize, usize) = (words[0].parse().unwrap(), words[1].parse().unwrap());
            let mut corners = vec![(x, y)];
            for pair in words[2..].chunks(2) {
                let (x, y) = corners[corners.len() - 1];
                let to: usize = pair[1].parse().unwrap();
                corners.push(if pair[0] == "H" { (to, y) } else { (x, to) });
            }
            corners.push((x, y));
            for piece in corners.windows(2) {
                if piece[0].0 == piece[1].0 {
                    let ends = (piece[0].1.min(piece[1].1), piece[0].1.max(piece[1].1));
                    (ends.0..ends.1).for_each(|row| crossings[row][piece[0].0] += 1);
                }
            }
        }
        for (row, crossings) in crossings.iter().enumerate() {
            let mut inside = 0;
            for column in 0..columns {
                inside += crossings[column];
                if inside % 2 == 1 {
                    let beneath = cells[row][column];
                    let ground = beneath.is_none_or(|beneath| beneath == paths[0].0);
                    assert!(ground, "two kinds in one cell");
                    cells[row][column] = Some(*kind);
                }
            }
        }
    }
    cells
}

#[test]
fn outlines_hold_the_cells_and_no_others() {
    // With a hole, a corner in which regions touch, and a region at each border.
    for (picture, ground) in [
        ("0000,0110,0100,0001", 0),
        ("01,10", 0),
        ("7", 7),
        ("01,22", 2),
        ("0120,0120,3333", 0),
        ("0000,0111,0101,0111", 0),
    ] {
        let rows: Vec<Vec<Option<u8>>> =
            picture.split(',').map(|row| row.bytes().map(|b| Some(b - b'0')).collect()).collect();
        let columns = rows[0].len();
        let mut outlines = Outlines::default();
        let mut above = vec![None; columns];
        for line in 0..=rows.len() {
            let below = rows.get(line).cloned().unwrap_or(vec![None; columns]);
            outlines.line(line, &above, &below);
            above = below;
        }
        let shape = (columns, rows.len());
        let paths = outlines.paths(shape);
        assert_eq!(filled(&paths, shape), rows, "{picture}: {paths:?}");
        assert_eq!(paths[0], (ground, format!("M0 0H{columns}V{}H0Z", rows.len())));
    }
}
