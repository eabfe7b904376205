//! Every number that a scene has, defined once: flags, TOML keys, help, captions, axes, columns and
//! docs/parameters.md are made of this table.

use std::f64::consts::PI;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::applies::{Applies, BlockBy, Choice, ShakenBy};
use super::directions::{Directions, MOVES_H, MOVES_V};
use super::record::LARGEST_PEAK;
use crate::model::pulse::Shape;

/// What a number belongs to: a table of a scene file, a heading of the help.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Section {
    /// The block and its plates.
    Block,
    /// The base.
    Base,
    /// The pulse.
    Pulse,
    /// The record.
    Record,
    /// Duration and criteria.
    Run,
}

impl Section {
    /// All of them, in the order of a scene file.
    pub const ALL: [Section; 5] = [Block, Base, Pulse, Record, Run];

    /// Name of the table in a scene file.
    pub fn key(self) -> &'static str {
        match self {
            Block => "block",
            Base => "base",
            Pulse => "pulse",
            Record => "record",
            Run => "run",
        }
    }

    /// The choices of a scene beside which it means something.
    pub const fn applies(self) -> Applies {
        let excitation: &[ShakenBy] = match self {
            Pulse => &[ShakenBy::Pulse],
            Record => &[ShakenBy::Record],
            Block | Base | Run => &[],
        };
        Applies { excitation, ..Applies::ALWAYS }
    }

    /// Its heading in the help.
    pub fn heading(self) -> &'static str {
        match self {
            Block => "Block",
            Base => "Base",
            Pulse => "Pulse",
            Record => "Record",
            Run => "Run",
        }
    }
}

/// The values that make sense at all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Legal {
    /// Any finite number.
    Finite,
    /// Any but zero.
    NotZero,
    /// Above zero.
    Positive,
    /// Zero and above.
    NotNegative,
    /// From the first to the last, both included.
    Within(f64, f64),
    /// Between -1 and 1, both excluded: over the base.
    InBase,
    /// Above the first, up to and with the last.
    AboveUpTo(f64, f64),
    /// A whole number from the first to the last.
    Whole(u32, u32),
}

impl Legal {
    /// True for a value that makes sense.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Finite => true,
                NotZero => value != 0.0,
                Positive => value > 0.0,
                NotNegative => value >= 0.0,
                Within(low, high) => value >= low && value <= high,
                InBase => value.abs() < 1.0,
                AboveUpTo(low, high) => value > low && value <= high,
                Whole(low, high) => {
                    value.fract() == 0.0 && value >= f64::from(low) && value <= f64::from(high)
                }
            }
    }

    /// The least and the largest value, and whether each of them is one itself.
    pub fn ends(self) -> ((f64, f64), (bool, bool)) {
        let any = (f64::NEG_INFINITY, f64::INFINITY);
        match self {
            Finite | NotZero => (any, (true, true)),
            Positive => ((0.0, any.1), (false, true)),
            NotNegative => ((0.0, any.1), (true, true)),
            Within(low, high) => ((low, high), (true, true)),
            InBase => ((-1.0, 1.0), (false, false)),
            AboveUpTo(low, high) => ((low, high), (false, true)),
            Whole(low, high) => ((f64::from(low), f64::from(high)), (true, true)),
        }
    }
}

impl fmt::Display for Legal {
    /// What a value must be, after "must".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finite => write!(f, "be a finite number"),
            NotZero => write!(f, "be a number other than zero"),
            Positive => write!(f, "be a positive number"),
            NotNegative => write!(f, "be 0 or more"),
            Within(low, high) => write!(f, "lie between {low} and {high}"),
            InBase => {
                write!(f, "lie between -1 and 1, because the centre of mass is above the base")
            }
            AboveUpTo(low, high) => write!(f, "lie above {low} and at most at {high}"),
            Whole(low, high) => write!(f, "be a whole number from {low} to {high}"),
        }
    }
}

/// The description of a number.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Which one.
    pub parameter: Parameter,
    /// Key in scene files, name of columns and arrays; with dashes the flag.
    pub key: &'static str,
    /// Symbol in formulas and on figures.
    pub symbol: &'static str,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// What it belongs to.
    pub section: Section,
    /// What it means.
    pub meaning: &'static str,
    /// Values that make sense at all.
    pub legal: Legal,
    /// Magnitudes that are not questioned.
    pub plausible: (f64, f64),
    /// What a magnitude beyond them may be instead.
    pub perhaps: &'static str,
    /// Its value where none is given, in words.
    pub default: &'static str,
    /// Where it is defined.
    pub source: &'static str,
    /// When a caption shows it, where it has one value.
    pub caption: Caption,
    /// The choices of a scene beside which it means something.
    pub applies: Applies,
    /// The range of its slider on the page.
    pub slider: Slider,
    /// The group of numbers that few scenes have in which the page shows it; empty for none.
    pub group: &'static str,
}

/// The range of a slider, and of a new axis: of use for most blocks. Fields take any number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Slider {
    /// Its first place.
    pub low: f64,
    /// Its last place.
    pub high: f64,
    /// Places lie evenly by the logarithm, or by the value.
    pub log: bool,
}

/// When a caption shows a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Caption {
    /// Always.
    Always,
    /// Where it is not what it is by default.
    Unusual,
    /// Never.
    Never,
}

const ANY: (f64, f64) = (0.0, f64::INFINITY);

/// A number of which nothing else is said.
const fn entry(
    parameter: Parameter,
    (key, symbol, unit): (&'static str, &'static str, &'static str),
    (section, legal, slider): (Section, Legal, Slider),
    meaning: &'static str,
    (default, source): (&'static str, &'static str),
) -> Entry {
    let (plausible, perhaps, caption) = (ANY, "", Caption::Unusual);
    let (applies, group) = (section.applies(), "");
    Entry {
        parameter,
        key,
        symbol,
        unit,
        section,
        meaning,
        legal,
        plausible,
        perhaps,
        default,
        source,
        caption,
        applies,
        slider,
        group,
    }
}

/// A slider whose places lie evenly by the value.
const fn even(low: f64, high: f64) -> Slider {
    Slider { low, high, log: false }
}

/// One whose places lie evenly by the logarithm.
const fn log(low: f64, high: f64) -> Slider {
    Slider { low, high, log: true }
}

impl Entry {
    /// The same, magnitudes beyond two ends questioned.
    const fn plausible(self, low: f64, high: f64, perhaps: &'static str) -> Entry {
        Entry { plausible: (low, high), perhaps, ..self }
    }

    /// The same, shown by every caption.
    const fn always(self) -> Entry {
        Entry { caption: Caption::Always, ..self }
    }

    /// The same, shown by none.
    const fn never(self) -> Entry {
        Entry { caption: Caption::Never, ..self }
    }

    /// The same, of a block that is no object of Table 1.
    const fn without_object(self) -> Entry {
        Entry { applies: Applies { block: &[BlockBy::Numbers], ..self.applies }, ..self }
    }

    /// The same, of a base that moves in some directions.
    const fn moving(self, isolation: &'static [Directions]) -> Entry {
        Entry { applies: Applies { isolation, ..self.applies }, ..self }
    }

    /// The same, in a group of the page.
    const fn within(self, group: &'static str) -> Entry {
        Entry { group, ..self }
    }

    /// The same, of pulses of some shapes.
    const fn shaped(self, shape: &'static [Shape]) -> Entry {
        Entry { applies: Applies { shape, ..self.applies }, ..self }
    }
}

use Legal::{AboveUpTo, Finite, InBase, NotNegative, NotZero, Positive, Whole, Within};
use Parameter as P;
use Section::{Base, Block, Pulse, Record, Run};

/// Makes the enum of a scene's numbers and their table. A row has the name of a number in Rust, its key, its symbol and its unit; its section, the
/// values that make sense, the range of its slider; what it means, its default in words, where it is defined; and what else is said of it.
macro_rules! parameters {
    ($(
        $parameter:ident = $key:literal, $symbol:literal, $unit:literal: $section:expr, $legal:expr, $slider:expr,
        $meaning:literal, $default:literal, $source:literal $(=> $($more:ident($($with:expr),*)).+)?;
    )*) => {
        /// A number of a scene.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Parameter {
            $(#[doc = $meaning] $parameter,)*
        }

        impl Parameter {
            /// How many there are.
            pub const COUNT: usize = [$($key),*].len();
        }

        /// The table, in the order of [`Parameter`].
        pub const PARAMETERS: [Entry; Parameter::COUNT] = [$(
            entry(
                Parameter::$parameter,
                ($key, $symbol, $unit),
                ($section, $legal, $slider),
                $meaning,
                ($default, $source),
            )$($(.$more($($with),*))+)?
        ),*];
    };
}

parameters! {
    HalfWidth = "half_width", "B", "m": Block, Positive, log(0.02, 2.0),
        "half the width of the base, between the edges on which the block really stands (too large a value is unsafe); give two of \
         half_width, height, slenderness and size",
        "", "Fig. 1" => plausible(0.002, 20.0, "metres are meant, not millimetres").always().without_object();
    Height = "height", "H", "m": Block, Positive, log(0.1, 10.0),
        "height of the centre of mass above the base: half the height of a uniform block",
        "", "Fig. 1" => plausible(0.005, 100.0, "metres are meant, not millimetres").always().without_object();
    Slenderness = "slenderness", "λ", "": Block, Positive, log(1.0, 20.0),
        "H/B, the height of the centre of mass over half the width",
        "", "section 2" => plausible(0.05, 100.0, "a ratio is meant, not an angle").always().without_object().within("Another measure of it");
    Size = "size", "R", "m": Block, Positive, log(0.1, 10.0),
        "half the diagonal, the root of B² + H²",
        "", "" => plausible(0.005, 100.0, "metres are meant, not millimetres").always().without_object().within("Another measure of it");
    Mass = "mass", "M", "kg": Block, Positive, log(10.0, 1e5),
        "mass; needed with plates, stiffnesses and forces. Otherwise it has no influence on the motion",
        "1, without plates", "section 2.1" => never().without_object();
    Inertia = "inertia", "J_C", "kg m²": Block, Positive, log(1.0, 1e6),
        "moment of inertia about the centre of mass",
        "the uniform rectangle's, M (B² + H²)/3", "section 2.1" => never().without_object().within("Another measure of it");
    Eccentricity = "eccentricity", "ε", "": Block, InBase, even(-0.8, 0.8),
        "e/B: offset of the centre of mass to the right, divided by B",
        "0", "section 3.3" => always();
    Offset = "offset", "e", "m": Block, Finite, even(-0.5, 0.5),
        "offset of the centre of mass to the right, in place of eccentricity; less than B",
        "", "Fig. 1" => plausible(0.0, 20.0, "metres are meant, not millimetres").always().within("Another measure of it");
    PlateH = "plate_h", "m_h", "kg": Block, NotNegative, even(0.0, 2000.0),
        "mass of the plate that moves horizontally only",
        "0", "Fig. 1" => never();
    PlateV = "plate_v", "m_v", "kg": Block, NotNegative, even(0.0, 2000.0),
        "mass of the plate that moves in both directions",
        "0", "Fig. 1" => never();
    TH = "t_h", "T_h", "s": Base, Positive, even(0.2, 6.0),
        "period of the horizontal isolation with its initial stiffness, before it yields",
        "", "(19)" => plausible(0.0, 30.0, "a period in seconds is meant").always().moving(MOVES_H);
    TV = "t_v", "T_v", "s": Base, Positive, even(0.05, 3.0),
        "period of the vertical isolation",
        "", "(20)" => plausible(0.0, 30.0, "a period in seconds is meant").always().moving(MOVES_V);
    Psi = "psi", "ψ", "": Base, Within(0.0, 1.0), even(0.0, 1.0),
        "stiffness after yielding divided by the initial stiffness",
        "0.25", "(10a)" => moving(MOVES_H).within("When it yields");
    XiH = "xi_h", "ξ_h", "": Base, Within(0.0, 10.0), even(0.0, 0.5),
        "horizontal viscous damping ratio, relative to the initial stiffness",
        "0.05", "(19)" => plausible(0.0, 1.0, "a ratio is meant, not percent").moving(MOVES_H);
    XiV = "xi_v", "ξ_v", "": Base, Within(0.0, 10.0), even(0.0, 0.5),
        "vertical viscous damping ratio",
        "0.1", "(20)" => plausible(0.0, 1.0, "a ratio is meant, not percent").moving(MOVES_V);
    AlphaY = "alpha_y", "α_y", "": Base, Positive, log(0.01, 1.0),
        "yield displacement divided by PGA_h/ω_h²: the strength of the base grows with the peak of the motion",
        "0.1", "(21)" => moving(MOVES_H).within("When it yields");
    UY = "u_y", "u_y", "m": Base, Positive, log(0.001, 0.5),
        "yield displacement, in place of alpha_y: a base that stays the same when the motion grows",
        "", "(11)" => plausible(1.0e-6, 1.0, "metres are meant, not millimetres").moving(MOVES_H).within("When it yields");
    YieldForce = "yield_force", "F_y", "N": Base, Positive, log(10.0, 1e5),
        "k_h u_y, in place of alpha_y: the force at which the base yields",
        "", "(10a)" => moving(MOVES_H).within("When it yields");
    BoucWenN = "bouc_wen_n", "n", "": Base, Whole(1, 100), even(1.0, 9.0),
        "exponent of the Bouc-Wen law",
        "2", "(11)" => moving(MOVES_H).within("When it yields");
    K1 = "k1", "k_1", "N/m": Base, Positive, log(1e3, 1e8),
        "stiffness of a bilinear device before it yields, in place of t_h",
        "", "(10a), (19)" => moving(MOVES_H);
    K2 = "k2", "k_2", "N/m": Base, NotNegative, log(1e2, 1e7),
        "stiffness of a bilinear device after it has yielded, in place of psi; at most the one before",
        "", "(10a)" => moving(MOVES_H);
    Qd = "qd", "Q_d", "N": Base, Positive, log(10.0, 1e6),
        "force of a bilinear device at zero displacement, in place of alpha_y; its yield displacement is Q_d/(k_1 - k_2)",
        "", "(10a), (11)" => moving(MOVES_H);
    Radius = "radius", "R_d", "m": Base, Positive, even(0.3, 6.0),
        "radius of a friction pendulum, with mu in place of t_h and psi",
        "", "" => plausible(0.05, 50.0, "metres are meant, not millimetres").moving(MOVES_H);
    Mu = "mu", "μ_d", "": Base, Within(0.0, 2.0), even(0.01, 0.2),
        "friction coefficient of a friction pendulum; u_y is the displacement before it slides, 0.0005 m unless given",
        "", "" => plausible(0.0, 0.5, "a coefficient is meant, not percent").moving(MOVES_H);
    StopGap = "stop_gap", "d", "m": Base, Positive, even(0.02, 1.0),
        "horizontal displacement at which the base meets its end stop; with stop_stiffness",
        "none", "" => plausible(1.0e-4, 10.0, "metres are meant, not millimetres").moving(MOVES_H).within("End stop");
    StopStiffness = "stop_stiffness", "k_s", "N/m": Base, Positive, log(1e4, 1e9),
        "stiffness of the end stop",
        "", "" => moving(MOVES_H).within("End stop");
    StopXi = "stop_xi", "ξ_s", "": Base, Within(0.0, 10.0), even(0.0, 0.5),
        "damping ratio of the end stop with the mass above, M + m_h + m_v; the stop never pulls",
        "0", "" => plausible(0.0, 1.0, "a ratio is meant, not percent").moving(MOVES_H).within("End stop");
    VHardening = "v_hardening", "v_c", "m": Base, Positive, log(0.005, 0.5),
        "displacement from the static position at which the vertical spring's force is twice that of its initial stiffness: it hardens by the cube",
        "none", "" => plausible(1.0e-5, 10.0, "metres are meant, not millimetres").moving(MOVES_V).within("Vertical spring that hardens");
    StaticDeflection = "static_deflection", "v_0", "m": Base, NotNegative, even(0.0, 0.5),
        "static deflection of the vertical isolation, for the column max_v; the motion does not depend on it",
        "g/ω_v²", "(20)" => plausible(0.0, 10.0, "metres are meant, not millimetres").moving(MOVES_V).within("Vertical spring that hardens");
    Omega = "omega", "Ω", "rad/s": Pulse, Positive, even(0.2, 20.0),
        "circular frequency of the pulse: its period is 2π/Ω",
        "", "(22)" => always();
    AH = "a_h", "A_h", "m/s²": Pulse, Finite, even(0.0, 20.0),
        "horizontal amplitude of the pulse: its largest acceleration",
        "", "(22a)" => plausible(0.0, 100.0, "m/s² are meant, not cm/s²").always();
    AV = "a_v", "A_v", "m/s²": Pulse, Finite, even(-10.0, 10.0),
        "vertical amplitude of the pulse",
        "0", "(22b)" => plausible(0.0, 100.0, "m/s² are meant, not cm/s²").always();
    Cycles = "cycles", "N", "": Pulse, AboveUpTo(0.0, 1000.0), even(0.5, 10.0),
        "cycles of a one-sine or one-cosine pulse",
        "1", "" => shaped(Shape::WITH_CYCLES);
    Gamma = "gamma", "γ", "": Pulse, Within(1.0, 100.0), even(1.0, 6.0),
        "number of cycles of a pulse of Mavroeidis & Papageorgiou, under its envelope",
        "2", "" => plausible(1.0, 20.0, "a number of cycles is meant").always().shaped(Shape::MODULATED);
    Phase = "phase", "ν", "rad": Pulse, Finite, even(-PI, PI),
        "phase of the cosine of a Mavroeidis & Papageorgiou pulse: with 0 the velocity is largest in the middle of the pulse, with π/2 it is zero there",
        "0", "" => plausible(0.0, 6.3, "radians are meant, not degrees").shaped(Shape::MODULATED);
    Scale = "scale", "SF", "": Record, NotZero, log(0.1, 10.0),
        "factor on both components",
        "1", "" => always();
    Pga = "pga", "PGA_h", "m/s²": Record, Positive, even(0.5, 20.0),
        "scale both components so that the horizontal peak is this",
        "", "" => plausible(0.5, LARGEST_PEAK, "m/s² are meant, not g").never();
    TMax = "t_max", "t_max", "s": Run, AboveUpTo(0.0, 1.0e5), even(5.0, 120.0),
        "simulated time",
        "30, or a record's duration", "section 3" => never();
    Tilt = "tilt", "φ_0", "rad": Run, Finite, even(-0.3, 0.3),
        "rotation of the block at the start, positive about the left corner",
        "0", "Fig. 1";
    Friction = "friction", "μ", "": Run, Positive, log(0.05, 2.0),
        "friction coefficient between block and base: cells in which the block would slide are marked; the model has no sliding",
        "none", "" => plausible(0.0, 5.0, "a coefficient is meant, not an angle");
    Restitution = "restitution", "η_φ", "": Run, AboveUpTo(0.0, 1.0), even(0.3, 1.0),
        "angular velocity after an impact divided by that before, instead of the law; only without isolation",
        "the law's", "(17c)" => moving(&[Directions::None]);
    RestitutionFactor = "restitution_factor", "r", "": Run, NotNegative, even(0.5, 1.0),
        "factor on the law's angular velocity after an impact; the linear momenta are kept; a factor with which an impact would raise the energy is refused",
        "1", "(15a), (15b), (17c)";
}

/// Parameters that say the same: a scene has one of each row at most.
pub const ALTERNATIVES: [&[Parameter]; 6] = [
    &[P::Eccentricity, P::Offset],
    &[P::TH, P::K1, P::Radius],
    &[P::Psi, P::K2, P::Mu],
    &[P::AlphaY, P::UY, P::YieldForce, P::Qd],
    &[P::Scale, P::Pga],
    &[P::Restitution, P::RestitutionFactor],
];

impl Parameter {
    /// Its description.
    pub fn entry(self) -> &'static Entry {
        &PARAMETERS[self as usize]
    }

    /// Its key: `t_h`.
    pub fn key(self) -> &'static str {
        self.entry().key
    }

    /// The number of a key.
    pub fn of_key(key: &str) -> Option<Parameter> {
        PARAMETERS.iter().find(|entry| entry.key == key).map(|entry| entry.parameter)
    }

    /// All of a section.
    pub fn of_section(section: Section) -> impl Iterator<Item = Parameter> {
        let own = PARAMETERS.iter().filter(move |entry| entry.section == section);
        own.map(|entry| entry.parameter)
    }

    /// The numbers that mean nothing beside a choice, in the order of the table.
    pub fn excluded_by(choice: Choice) -> impl Iterator<Item = Parameter> {
        let excluded = PARAMETERS.iter().filter(move |entry| !entry.applies.beside(choice));
        excluded.map(|entry| entry.parameter)
    }

    /// The numbers of a base that moves in a direction, [`Horizontal`](Directions::Horizontal) or
    /// [`Vertical`](Directions::Vertical).
    pub fn of_direction(direction: Directions) -> impl Iterator<Item = Parameter> {
        let own =
            PARAMETERS.iter().filter(move |entry| entry.applies.isolation.contains(&direction));
        own.map(|entry| entry.parameter)
    }
}

impl Entry {
    /// Symbol and unit: `T_h [s]`.
    pub fn label(&self) -> String {
        match self.unit {
            "" => self.symbol.into(),
            unit => format!("{} [{unit}]", self.symbol),
        }
    }

    /// A value with symbol and unit: `T_h = 2 s`.
    pub fn written(&self, value: impl fmt::Display) -> String {
        match self.unit {
            "" => format!("{} = {value}", self.symbol),
            unit => format!("{} = {value} {unit}", self.symbol),
        }
    }

    /// The flag: `--t-h`.
    pub fn flag(&self) -> String {
        format!("--{}", self.key.replace('_', "-"))
    }

    /// The least and the largest plausible value; the least is negative where the number may be, because `plausible` has magnitudes.
    pub fn plausible_ends(&self) -> (f64, f64) {
        let ((least, _), _) = self.legal.ends();
        let (low, high) = self.plausible;
        if low == 0.0 && least < 0.0 { (least.max(-high), high) } else { (low, high) }
    }

    /// From where to where its values may lie, in words: what makes sense at all and is plausible; empty where
    /// there are no ends.
    pub fn range(&self) -> String {
        let ((low, high), (has_low, has_high)) = self.legal.ends();
        let (least, most) = self.plausible_ends();
        let (high, has_high) = if most < high { (most, true) } else { (high, has_high) };
        let (low, has_low) = if least > low { (least, true) } else { (low, has_low) };
        match (low.is_finite() && high.is_finite(), has_low, has_high) {
            (false, ..) => String::new(),
            (true, true, true) => format!("{low} to {high}"),
            (true, false, true) => format!("above {low}, up to {high}"),
            (true, true, false) => format!("{low} or more, below {high}"),
            (true, false, false) => format!("above {low}, below {high}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A displacement may lie on either side of the middle, a length is above zero.
    #[test]
    fn a_number_that_may_be_below_zero_has_plausible_values_there() {
        let ends = |one: Parameter| (one.entry().plausible_ends(), one.entry().range());
        assert_eq!(ends(P::Offset), ((-20.0, 20.0), "-20 to 20".into()));
        assert_eq!(ends(P::Eccentricity), ((-1.0, f64::INFINITY), "above -1, below 1".into()));
        assert_eq!(ends(P::Mu), ((0.0, 0.5), "0 to 0.5".into()));
        assert_eq!(ends(P::Radius), ((0.05, 50.0), "0.05 to 50".into()));
    }

    /// An end that is included makes sense itself, another one does not; all beyond them makes none.
    #[test]
    fn ends_are_where_sense_ends() {
        for entry in PARAMETERS {
            let ((low, high), (has_low, has_high)) = entry.legal.ends();
            for (end, has, beyond) in [(low, has_low, -1.0), (high, has_high, 1.0)] {
                if end.is_finite() {
                    assert_eq!(entry.legal.holds(end), has, "{} {end}", entry.key);
                    assert!(!entry.legal.holds(end + beyond), "{} {end}", entry.key);
                }
            }
        }
    }

    #[test]
    fn the_table_is_in_the_order_of_its_numbers_and_no_key_stands_twice() {
        for (index, entry) in PARAMETERS.iter().enumerate() {
            assert_eq!(entry.parameter as usize, index, "{}", entry.key);
            assert_eq!(Parameter::of_key(entry.key), Some(entry.parameter));
            let (low, high) = entry.plausible;
            assert!(low < high && (entry.perhaps.is_empty() == (high == f64::INFINITY)));
        }
    }

    #[test]
    fn a_choice_excludes_the_numbers_that_mean_nothing_beside_it() {
        let across = "t_h psi xi_h alpha_y u_y yield_force bouc_wen_n k1 k2 qd radius mu stop_gap stop_stiffness stop_xi";
        let up = "t_v xi_v v_hardening static_deflection";
        for (choice, keys) in [
            (Choice::Block(BlockBy::Numbers), ""),
            (Choice::Block(BlockBy::Object), "half_width height slenderness size mass inertia"),
            (Choice::Isolation(Directions::Dual), "restitution"),
            (Choice::Isolation(Directions::Horizontal), &format!("{up} restitution")),
            (Choice::Isolation(Directions::Vertical), &format!("{across} restitution")),
            (Choice::Isolation(Directions::None), &format!("{across} {up}")),
            (Choice::Excitation(ShakenBy::Pulse), "scale pga"),
            (Choice::Excitation(ShakenBy::Record), "omega a_h a_v cycles gamma phase"),
            (Choice::Shape(Shape::OneCosine), "gamma phase"),
            (Choice::Shape(Shape::Ricker), "cycles gamma phase"),
            (Choice::Shape(Shape::MavroeidisPapageorgiou), "cycles"),
        ] {
            let mut excluded: Vec<&str> =
                Parameter::excluded_by(choice).map(Parameter::key).collect();
            let mut wanted: Vec<&str> = keys.split_whitespace().collect();
            excluded.sort_unstable();
            wanted.sort_unstable();
            assert_eq!(excluded, wanted, "{choice:?}");
        }
    }
}
