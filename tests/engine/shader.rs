//! The shader's text: it parses, it holds no function that a driver may get wrong, and its
//! structs are laid out as the host's.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, TypeInner};
use topple::backend::gpu::shader::{self, Switches};
use topple::backend::gpu::tile::Tile;
use topple::model::block::{Corner, Model};
use topple::model::excitation::{Cell, Drive, Ground, Horizontal, Steps, Vertical};
use topple::model::motion::Motion;
use topple::model::precision::Precision;
use topple::model::pulse::Shape;
use topple::stepping::extremes::Extremes;
use topple::stepping::log::Event;
use topple::stepping::state::State;

fn parse(precision: Precision, switches: Switches) -> Module {
    let source = shader::source(precision, switches);
    naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)))
}

#[test]
fn both_precisions_validate() {
    for precision in [Precision::F32, Precision::F64] {
        for switches in [Switches::Forgotten, Switches::Kept] {
            let module = parse(precision, switches);
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::FLOAT64);
            validator.validate(&module).unwrap();
            assert_eq!(module.entry_points.len(), 2);
        }
    }
}

#[test]
fn no_built_in_that_has_no_f64_form_is_called() {
    let banned = "sin cos tan asin acos atan atan2 exp exp2 \
                  log log2 pow sinh cosh tanh fma inverseSqrt smoothstep";
    for (name, text) in shader::files(Precision::F64, Switches::Kept) {
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for function in banned.split(' ').map(|name| format!("{name}(")) {
                let called = line.match_indices(&function).any(|(at, _)| {
                    let before = line[..at].chars().next_back();
                    !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
                });
                assert!(!called, "{name} calls {function}): {line}");
            }
        }
    }
}

/// Offsets of a struct's members in a shader, and its size.
fn layout(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
    let found = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name));
    match &found.unwrap_or_else(|| panic!("no struct {name}")).1.inner {
        TypeInner::Struct { members, span } => {
            let members = members.iter().map(|m| (m.name.clone().unwrap(), m.offset)).collect();
            (members, *span)
        }
        _ => panic!("{name} is no struct"),
    }
}

macro_rules! same_layout {
    ($precision:expr, $real:ty, $name:ident { $($field:ident),* $(,)? }) => {
        let (members, size) = layout(&parse($precision, Switches::Kept), stringify!($name));
        let host: Vec<(String, u32)> = vec![
            $((stringify!($field).to_string(), std::mem::offset_of!($name<$real>, $field) as u32)),*
        ];
        assert_eq!(members, host, "{} in {}", stringify!($name), stringify!($real));
        assert_eq!(size as usize, size_of::<$name<$real>>(), "{}", stringify!($name));
    };
}

macro_rules! offsets {
    ($($field:ident),* $(,)?) => {
        vec![$((stringify!($field).to_string(), std::mem::offset_of!(Tile, $field) as u32)),*]
    };
}

macro_rules! same_layouts {
    ($precision:expr, $real:ty) => {
        same_layout!(
            $precision,
            $real,
            Corner { side, arm, inertia, overturn, eta_phi, eta_u, eta_v, padding }
        );
        same_layout!(
            $precision,
            $real,
            Model {
                left,
                right,
                height,
                mu_h,
                mu_v,
                gravity,
                inverse_mu_h,
                inverse_mu_v,
                least_arm,
                topple_energy,
                impact_gain,
                normal_share,
                normal_by_shear,
                normal_by_turn,
                shear_by_normal,
                shear_by_turn,
                padding_0,
                padding_1
            }
        );
        same_layout!(
            $precision,
            $real,
            Horizontal {
                post_yield,
                hysteretic,
                damping_h,
                inverse_yield,
                yield_energy,
                reach_h,
                stop_gap,
                stop_stiffness,
                stop_damping,
                stop_rate,
                finite,
            }
        );
        same_layout!(
            $precision,
            $real,
            Vertical { stiffness_v, damping_v, deflection, reach_v, hardening_v, finite }
        );
        same_layout!(
            $precision,
            $real,
            Drive { amplitude_h, amplitude_v, scale, tilt, envelope, carrier, finite }
        );
        same_layout!($precision, $real, Cell { horizontal, vertical, drive, steps, body, padding });
        same_layout!(
            $precision,
            $real,
            Steps {
                phase_step,
                step_forced,
                step_free,
                rest_speed,
                steps_forced,
                steps,
                substeps,
                finite
            }
        );
        same_layout!($precision, $real, Ground { h, v });
        same_layout!($precision, $real, Motion { u, du, v, dv, z, phi, dphi });
        same_layout!($precision, $real, Event { motion, fraction, kind, step, mode, padding });
        same_layout!(
            $precision,
            $real,
            Extremes {
                max_phi_left,
                max_phi_right,
                max_u,
                least_v,
                most_v,
                min_contact,
                friction,
                acc_plate,
                acc_block,
                acc_plate_total,
                acc_block_total,
                base_load,
                stop_force,
                stop_hits
            }
        );
        same_layout!(
            $precision,
            $real,
            State {
                motion,
                extremes,
                uplift_fraction,
                end_fraction,
                mode,
                step,
                impacts,
                uplifts,
                uplift_step,
                status
            }
        );
    };
}

#[test]
fn host_structs_are_laid_out_as_the_shaders() {
    same_layouts!(Precision::F32, f32);
    same_layouts!(Precision::F64, f64);
}

/// A uniform buffer holds structs in structs at whole 16 bytes, and is as long.
#[test]
fn uniform_numbers_lie_as_a_uniform_buffer_asks() {
    assert_eq!((size_of::<Corner<f32>>() % 16, size_of::<Corner<f64>>() % 16), (0, 0));
    assert_eq!(size_of::<Tile>() % 16, 0);
    for precision in [Precision::F32, Precision::F64] {
        let module = parse(precision, Switches::Forgotten);
        let uniform: Vec<&str> = module
            .global_variables
            .iter()
            .filter(|(_, variable)| variable.space == naga::AddressSpace::Uniform)
            .filter_map(|(_, variable)| variable.name.as_deref())
            .collect();
        assert_eq!(uniform, ["uniform_model", "dispatch", "tile"]);
    }
}

/// WebGPU lets a kernel have eight storage buffers.
#[test]
fn a_kernel_has_no_more_storage_buffers_than_every_device_allows() {
    for switches in [Switches::Forgotten, Switches::Kept] {
        let module = parse(Precision::F32, switches);
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::FLOAT64);
        let info = validator.validate(&module).unwrap();
        for (index, entry) in module.entry_points.iter().enumerate() {
            let storage = module.global_variables.iter().filter(|(handle, variable)| {
                let used = !info.get_entry_point(index)[*handle].is_empty();
                used && matches!(variable.space, naga::AddressSpace::Storage { .. })
            });
            let count = storage.count();
            assert!(count <= 8, "{} has {count}", entry.name);
        }
    }
}

/// Structs of words alone.
#[test]
fn words_are_laid_out_as_the_shaders() {
    let (members, size) = layout(&parse(Precision::F32, Switches::Kept), "Tile");
    let host: Vec<(String, u32)> = offsets!(
        horizontal,
        vertical,
        drive,
        clock,
        bodies,
        across,
        up,
        counts,
        levers,
        up_values,
        shared_contact,
        still,
        cells,
        columns,
        first_column,
        first_row,
        order,
        listed,
        first_slot,
        slots,
        number,
        padding_0,
        padding_1,
        padding_2
    );
    assert_eq!(members, host);
    assert_eq!(size as usize, size_of::<Tile>());
    let (_, size) = layout(&parse(Precision::F32, Switches::Kept), "Tally");
    assert_eq!(u64::from(size), topple::backend::gpu::slots::TALLY);
}

/// Constants that stand in both twins.
#[test]
fn constants_agree_with_the_twin() {
    use topple::backend::gpu::tile;
    use topple::cells::contact::motions;
    use topple::model::block;
    use topple::stepping::{certificate, forcing, guards, state};
    let module = parse(Precision::F32, Switches::Kept);
    let value = |name: &str| {
        let (_, constant) = module
            .constants
            .iter()
            .find(|(_, c)| c.name.as_deref() == Some(name))
            .unwrap_or_else(|| panic!("no constant {name}"));
        match module.global_expressions[constant.init] {
            naga::Expression::Literal(naga::Literal::U32(value)) => value,
            ref other => panic!("{name} is {other:?}"),
        }
    };
    for (name, twin) in [
        ("FULL_CONTACT", block::FULL_CONTACT),
        ("ROCKING_LEFT", block::ROCKING_LEFT),
        ("ROCKING_RIGHT", block::ROCKING_RIGHT),
        ("RUNNING", state::RUNNING),
        ("FINISHED", state::FINISHED),
        ("OVERTURNED_LEFT", state::OVERTURNED_LEFT),
        ("OVERTURNED_RIGHT", state::OVERTURNED_RIGHT),
        ("EVENT_LIMIT", state::EVENT_LIMIT),
        ("DIVERGED", state::DIVERGED),
        ("PROVED", state::PROVED),
        ("STEPS_A_TRY", certificate::STEPS_A_TRY),
        ("MOST_STEPS", forcing::MOST_STEPS),
        ("NOTHING", guards::NOTHING),
        ("UPLIFT_LEFT", guards::UPLIFT_LEFT),
        ("UPLIFT_RIGHT", guards::UPLIFT_RIGHT),
        ("IMPACT", guards::IMPACT),
        ("OVERTURN", guards::OVERTURN),
        ("KINK", guards::KINK),
        ("EVENT_BOUND", guards::EVENT_BOUND),
        ("LOCATE_BOUND", guards::LOCATE_BOUND),
        ("IN_ORDER", tile::IN_ORDER),
        ("LISTED", tile::LISTED),
        ("SIDES", topple::backend::gpu::slots::SIDES as u32),
        ("DISPLACEMENT", motions::DISPLACEMENT as u32),
        ("VELOCITY", motions::VELOCITY as u32),
        ("ACCELERATION", motions::ACCELERATION as u32),
        ("LOWER", motions::LOWER as u32),
        ("TOP", motions::TOP as u32),
        ("BOTTOM", motions::BOTTOM as u32),
        ("LOWER_SO_FAR", motions::LOWER_SO_FAR as u32),
        ("ONE_SINE", Shape::OneSine as u32),
        ("ONE_COSINE", Shape::OneCosine as u32),
        ("HALF_SINE", Shape::HalfSine as u32),
        ("RECTANGLE", Shape::Rectangle as u32),
        ("RICKER", Shape::Ricker as u32),
        ("RICKER_ANTISYMMETRIC", Shape::RickerAntisymmetric as u32),
        ("MAVROEIDIS_PAPAGEORGIOU", Shape::MavroeidisPapageorgiou as u32),
        ("LEAST_SO_FAR", motions::LEAST_SO_FAR as u32),
        ("Z", motions::Z as u32),
        ("UPPER", motions::UPPER as u32),
        ("UPPER_SO_FAR", motions::UPPER_SO_FAR as u32),
        ("MINUS_LOWER_SO_FAR", motions::MINUS_LOWER_SO_FAR as u32),
        ("MAGNITUDE_SO_FAR", motions::MAGNITUDE_SO_FAR as u32),
        ("LEAST", motions::LEAST as u32),
        ("MAGNITUDE", motions::MAGNITUDE as u32),
    ] {
        assert_eq!(value(name), twin, "{name}");
    }
}
