//! Examples in the help of each command. A test parses each of them, and measures their lines.

/// What the values of a number are, for commands that make maps.
macro_rules! values {
    () => {
        "\
VALUES of a number: one value; start:stop:count, both ends included; start:stop:count:log, each value the same factor \
larger than the one before; or a list a,b,c. Numbers with several values are the axes of the sweep, at most six. A value outside \
of its range is refused; --force accepts implausible values.

"
    };
}

/// Of `topple` itself.
pub const TOPPLE: &str = "\
Examples:
  topple                                       the default map, into ./topple-out
  topple pulse --object 1 --t-h 1.75 --t-v 0.75 --omega 0.2:15:400 \\
    --a-h 0.1:15:400 --out map
  topple seismic --object 1 --t-h 0.5:4:200 --t-v 0.02:2:200 --out record
  topple history --object 1 --t-h 1.75 --t-v 0.75 --omega 9 --a-h 8.4 \\
    --out cell
  topple scene                                 a scene file to start from";

/// Of `topple pulse`.
pub const PULSE: &str = concat!(
    values!(),
    "\
Examples:
  A map over the pulse's frequency and amplitude:
    topple pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 \\
      --omega 0.2:15:400 --a-h 0.1:15:400
  Over the eccentricity and the period of the base, for one pulse:
    topple pulse --object 2 --eccentricity -0.6:0.6:200 --t-h 0.5:4:200 \\
      --t-v 0.5 --omega 6 --a-h 5
  Your own block on the ground, a curve along the amplitude:
    topple pulse --half-width 0.3 --height 1.2 --isolation none \\
      --pulse ricker --omega 5 --a-h 1:10:500
  Probabilities if the eccentricity and the damping are not known exactly, from 256 samples:
    topple pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 \\
      --omega 0.2:15:200 --a-h 0.1:15:200 \\
      --vary 'eccentricity=normal(0.2,0.02)' \\
      --vary 'xi-h=lognormal(0.05,0.3)' --samples 256
  The time and the disk that a large map needs:
    topple pulse --object 1 --t-h 1.75 --t-v 0.75 --omega 0.2:15:8192 \\
      --a-h 0.1:15:8192 --dry-run"
);

/// Of `topple seismic`.
pub const SEISMIC: &str = concat!(
    values!(),
    "\
Examples:
  A map over both periods of the base under the synthetic pair of records:
    topple seismic --object 1 --t-h 0.5:4:200 --t-v 0.02:2:200
  Under your own records, scaled to a horizontal peak of 5 m/s²:
    topple seismic --object 1 --horizontal H.AT2 --vertical UP.AT2 --pga 5 \\
      --t-h 0.5:4:200 --t-v 0.02:2:200
  Where rocking is chaotic: the probability in each pixel instead of one outcome:
    topple seismic --object 1 --t-h 1.6:1.95:60 --t-v 0.1:0.16:60 --pixel
  How sharp the boundaries of that map are:
    topple seismic --object 1 --t-h 1.6:1.95:150 --t-v 0.1:0.16:150 --sharpness
  A column of numbers, horizontal isolation alone, over its period and the eccentricity:
    topple seismic --object 3 --horizontal a.txt --dt 0.01 --units g \\
      --isolation horizontal --t-h 0.5:4:200 --eccentricity 0:0.6:100"
);

/// Of `topple history`.
pub const HISTORY: &str = "\
Examples:
  Under a pulse:
    topple history --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 \\
      --omega 9 --a-h 8.4 --out cell
  Under a record, by the reference:
    topple history --object 1 --horizontal H.AT2 --t-h 2 --t-v 0.1 \\
      --backend reference --out cell";

/// Of `topple run`.
pub const RUN: &str = "\
Examples:
  A scene file:
    topple run scene.toml --out map
  An earlier run again, with half the step:
    topple run map/run.json --step 0.00390625 --out again";

/// Of `topple explore`.
pub const EXPLORE: &str = "\
Examples:
  The scene of the command topple without arguments:
    topple explore
  A scene file, at a fixed port, without opening a browser:
    topple explore scene.toml --port 8080 --no-open
  The page as a folder of files, for any static web server:
    topple explore scene.toml --export page";

/// Of `topple suite`.
pub const SUITE: &str = "\
Examples:
  A download from PEER, as it was unpacked:
    topple suite records --out suite
  Your own list, with the columns id,horizontal,vertical,dt,units,scale,weight:
    topple suite list.csv --strict --out suite";

/// Of `topple envelope`.
pub const ENVELOPE: &str = "\
Examples:
  Which periods keep a statue standing under all records of a folder, with 40 cm of room and 5 cm up and down:
    topple envelope --object 1 --u-y 0.01 --t-h 0.5:5:60 --t-v 0.05:1:60 \\
      --suite records --limit-u 0.4 --limit-v 0.05
  Under 95 % of them, each in both directions:
    topple envelope --object 1 --u-y 0.01 --t-h 0.5:5:60 --t-v 0.05:1:60 \\
      --suite records --standing 0.95 --both-directions
  How likely a statue overturns if its centre of mass is not known exactly:
    topple envelope --object 1 --u-y 0.01 --t-h 2 --t-v 0.5 --suite records \\
      --eccentricity 0.1 --vary 'eccentricity=normal(0.1,0.05)'";

/// Of `topple fragility`.
pub const FRAGILITY: &str = "\
Examples:
  How likely a statue on a dual isolation overturns, by the largest acceleration of the ground:
    topple fragility --object 1 --u-y 0.01 --t-h 2 --t-v 0.5 --suite records \\
      --levels 0.5:20:20:log
  Its annual rate at a site, and the periods at which it is below 1 in 2500 years:
    topple fragility --object 1 --u-y 0.01 --t-h 0.5:5:30 --t-v 0.05:1:30 \\
      --suite records --im sa:1 --levels 0.5:20:20:log --hazard site.csv \\
      --hazard-units g --target 0.0004
  Its curves for OpenQuake and pelicun, intervals by recording:
    topple fragility --object 1 --u-y 0.01 --t-h 2 --t-v 0.5 --suite records \\
      --levels 0.5:20:20:log --resample recording --export nrml,pelicun";

/// Of `topple report`.
pub const REPORT: &str = "\
Examples:
  A map, and the fragility of one of its bases, as a page:
    topple report map fragility --out report.html
  The same to be printed:
    topple report map fragility --out report.pdf";

/// Of `topple compare`.
pub const COMPARE: &str = "\
DEVICES is a CSV. Its heading has device, a name, and keys of a scene (docs/parameters.md), such as t_h, psi, u_y, isolation or \
object. Each line is a device with one value of each key; an empty field is ignored. Numbers that all devices share are given by flags.

Examples:
  A statue on the bases of a list, with 25 cm of room and 3 cm up and down:
    topple compare devices.csv --object 1 --suite records --limit-u 0.25 \\
      --limit-v 0.03
  How much stronger the motions may be, each in both directions:
    topple compare devices.csv --object 1 --suite records --limit-u 0.25 \\
      --scales 0.5:3:26 --both-directions
  Annual rates of overturning at a site:
    topple compare devices.csv --object 1 --suite records --im sa:1 \\
      --levels 0.5:20:20:log --hazard site.csv --hazard-units g";

/// Of `topple merge`.
pub const MERGE: &str = "\
Examples:
  Two shards of a map, on two machines, and the map:
    topple run scene.toml --tile 1/2 --out shards
    topple run scene.toml --tile 2/2 --out shards
    topple merge shards --out map";

/// Of `topple figures`.
pub const FIGURES: &str = "\
Examples:
  A figure of the paper:
    topple figures --only fig12 --out figures
  All of them, records from a folder, 100 cells a side:
    topple figures --records records --cells 100 --out figures";

/// Of `topple chart`.
pub const CHART: &str = "\
Examples:
    topple chart --out chart";

/// Of `topple bench`.
pub const BENCH: &str = "\
Examples:
    topple bench";

/// Of `topple completions`.
pub const COMPLETIONS: &str = "\
Examples:
    topple completions bash";

/// Of `topple man`.
pub const MAN: &str = "\
The page is in the format of manual pages; show it on Linux with: topple man | man -l -

Examples:
    topple man
    topple man pulse";
