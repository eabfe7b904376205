//! A shader's text with its operations in f32 replaced by calls.

use std::collections::HashMap;

use naga::back::wgsl::{WriterFlags, write_string};
use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{
    Arena, BinaryOperator, Block, Expression, Function, Handle, MathFunction, Module, Range,
    Scalar, Span, Statement, SwitchCase, TypeInner,
};
use topple::backend::gpu::pipelines::WORKGROUP;

/// How sums and products are rounded.
#[derive(Clone, Copy, PartialEq)]
pub enum Rounding {
    Nearest,
    TowardZero,
    EitherWay,
}

/// Whether a sum takes in a product before it is rounded, and which of two.
#[derive(Clone, Copy, PartialEq)]
pub enum Fusing {
    None,
    Left,
    Right,
}

/// What a device does; see `device.wgsl`.
#[derive(Clone, Copy)]
pub struct Device {
    /// A quotient is off by between so many ULP.
    pub division: (i32, i32),
    /// The same of a square root.
    pub root: (i32, i32),
    pub rounding: Rounding,
    pub fusing: Fusing,
    /// Numbers whose bits are below these, but for the sign, are zero.
    pub flushed_below: u32,
    /// A comparison with a NaN holds.
    pub nans_inverted: bool,
    /// Results that are not finite are any number.
    pub indeterminate: bool,
    /// Every operation is a call, also those that are left as they are.
    pub everywhere: bool,
    /// Another seed gives other errors.
    pub seed: u32,
}

impl Device {
    /// One that does nothing of this.
    pub const EXACT: Device = Device {
        division: (0, 0),
        root: (0, 0),
        rounding: Rounding::Nearest,
        fusing: Fusing::None,
        flushed_below: 0,
        nans_inverted: false,
        indeterminate: false,
        everywhere: false,
        seed: 0,
    };

    /// The constants of `device.wgsl`.
    fn constants(&self) -> String {
        let (low, high) = self.division;
        let (root_low, root_high) = self.root;
        format!(
            "const DIVISION_LOW = {low}i;\nconst DIVISION_HIGH = {high}i;\n\
             const ROOT_LOW = {root_low}i;\nconst ROOT_HIGH = {root_high}i;\n\
             const ROUNDING = {}i;\nconst FLUSHED_BELOW = {}u;\nconst NANS_INVERTED = {};\n\
             const INDETERMINATE = {};\nconst SEED = {}u;\n",
            self.rounding as u8,
            self.flushed_below,
            self.nans_inverted,
            self.indeterminate,
            self.seed
        )
    }
}

/// A call in place of an operation.
type Call = (Handle<Function>, Vec<Handle<Expression>>);

/// Finds what is to be replaced in a function.
struct Finder<'a> {
    device: &'a Device,
    module: &'a Module,
    info: &'a FunctionInfo,
    expressions: &'a Arena<Expression>,
}

impl Finder<'_> {
    fn is_f32(&self, handle: Handle<Expression>) -> bool {
        let inner = self.info[handle].ty.inner_with(&self.module.types);
        matches!(inner, TypeInner::Scalar(Scalar::F32))
    }

    /// The numbers of a product that a sum of this one and another may take in.
    fn product(&self, handle: Handle<Expression>) -> Option<[Handle<Expression>; 2]> {
        match self.expressions[handle] {
            Expression::Binary { op: BinaryOperator::Multiply, left, right } => Some([left, right]),
            _ => None,
        }
    }

    /// The fused operation that a sum or a difference becomes.
    fn fused(
        &self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Option<(&'static str, Vec<Handle<Expression>>)> {
        let subtracts = op == BinaryOperator::Subtract;
        let by_left = self.product(left).map(|[a, b]| {
            (if subtracts { "device_fused_less" } else { "device_fused" }, vec![a, b, right])
        });
        let by_right = self.product(right).map(|[a, b]| {
            (if subtracts { "device_fused_from" } else { "device_fused" }, vec![a, b, left])
        });
        match self.device.fusing {
            Fusing::None => None,
            Fusing::Left => by_left.or(by_right),
            Fusing::Right => by_right.or(by_left),
        }
    }

    /// What an operation is to be replaced by.
    fn call(&self, expression: &Expression) -> Option<(&'static str, Vec<Handle<Expression>>)> {
        let device = self.device;
        let any_result = device.everywhere || device.flushed_below > 0 || device.indeterminate;
        let any_sum = any_result || device.rounding != Rounding::Nearest;
        let any_comparison = device.everywhere || device.nans_inverted || device.flushed_below > 0;
        match *expression {
            Expression::Binary { op, left, right } if self.is_f32(left) => {
                let fused = match op {
                    BinaryOperator::Add | BinaryOperator::Subtract => self.fused(op, left, right),
                    _ => None,
                };
                let (wanted, function) = match op {
                    BinaryOperator::Add => (any_sum, "device_sum"),
                    BinaryOperator::Subtract => (any_sum, "device_difference"),
                    BinaryOperator::Multiply => (any_sum, "device_product"),
                    BinaryOperator::Divide => {
                        (any_result || device.division != (0, 0), "device_quotient")
                    }
                    BinaryOperator::Less | BinaryOperator::Greater => {
                        (any_comparison, "device_less")
                    }
                    BinaryOperator::LessEqual | BinaryOperator::GreaterEqual => {
                        (any_comparison, "device_at_most")
                    }
                    BinaryOperator::Equal => (any_comparison, "device_equal"),
                    BinaryOperator::NotEqual => (any_comparison, "device_unequal"),
                    _ => (false, ""),
                };
                let turned = matches!(op, BinaryOperator::Greater | BinaryOperator::GreaterEqual);
                let arguments = if turned { vec![right, left] } else { vec![left, right] };
                fused.or(wanted.then_some((function, arguments)))
            }
            Expression::Math { fun, arg, arg1, .. } if self.is_f32(arg) => {
                let (wanted, function) = match fun {
                    MathFunction::Sqrt => (any_result || device.root != (0, 0), "device_root"),
                    MathFunction::Min => (any_comparison, "device_min"),
                    MathFunction::Max => (any_comparison, "device_max"),
                    _ => (false, ""),
                };
                wanted.then(|| (function, [arg].into_iter().chain(arg1).collect()))
            }
            _ => None,
        }
    }
}

/// A block in which calls are made where operations were.
fn with_calls(block: &Block, calls: &HashMap<Handle<Expression>, Call>) -> Block {
    let mut altered = Block::new();
    for statement in block.iter() {
        let statement = match statement.clone() {
            Statement::Emit(range) => {
                for handle in range {
                    let statement = match calls.get(&handle).cloned() {
                        Some((function, arguments)) => {
                            Statement::Call { function, arguments, result: Some(handle) }
                        }
                        None => Statement::Emit(Range::new_from_bounds(handle, handle)),
                    };
                    altered.push(statement, Span::UNDEFINED);
                }
                continue;
            }
            Statement::Block(block) => Statement::Block(with_calls(&block, calls)),
            Statement::If { condition, accept, reject } => Statement::If {
                condition,
                accept: with_calls(&accept, calls),
                reject: with_calls(&reject, calls),
            },
            Statement::Switch { selector, cases } => {
                let altered =
                    |case: SwitchCase| SwitchCase { body: with_calls(&case.body, calls), ..case };
                Statement::Switch { selector, cases: cases.into_iter().map(altered).collect() }
            }
            Statement::Loop { body, continuing, break_if } => Statement::Loop {
                body: with_calls(&body, calls),
                continuing: with_calls(&continuing, calls),
                break_if,
            },
            other => other,
        };
        altered.push(statement, Span::UNDEFINED);
    }
    altered
}

/// Replaces a function's operations; how many.
fn alter(function: &mut Function, calls: &HashMap<Handle<Expression>, Call>) -> usize {
    for (handle, (called, _)) in calls {
        function.expressions[*handle] = Expression::CallResult(*called);
    }
    function.body = with_calls(&function.body, calls);
    calls.len()
}

fn validate(module: &Module) -> ModuleInfo {
    Validator::new(ValidationFlags::all(), Capabilities::FLOAT64).validate(module).unwrap()
}

/// A shader's text as a device runs it, and the operations that were replaced.
pub fn shader(source: &str, device: &Device) -> (String, usize) {
    let text = format!("{}{}\n{source}", device.constants(), include_str!("device.wgsl"));
    let mut module = naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|error| unreachable!("{}", error.emit_to_string(&text)));
    let original = module.clone();
    let info = validate(&original);
    let of_device = |function: &Function| {
        function.name.as_deref().is_some_and(|name| name.starts_with("device_"))
    };
    let named: HashMap<&str, Handle<Function>> = original
        .functions
        .iter()
        .filter_map(|(handle, function)| Some((function.name.as_deref()?, handle)))
        .collect();
    let calls = |function: &Function, info: &FunctionInfo| -> HashMap<Handle<Expression>, Call> {
        let expressions = &function.expressions;
        let finder = Finder { device, module: &original, info, expressions };
        let call = |(handle, expression)| {
            let (name, arguments) = finder.call(expression)?;
            Some((handle, (named[name], arguments)))
        };
        expressions.iter().filter_map(call).collect()
    };
    let mut altered = 0;
    for (handle, function) in original.functions.iter().filter(|(_, f)| !of_device(f)) {
        altered += alter(&mut module.functions[handle], &calls(function, &info[handle]));
    }
    for (index, entry) in module.entry_points.iter_mut().enumerate() {
        let function = &original.entry_points[index].function;
        altered += alter(&mut entry.function, &calls(function, info.get_entry_point(index)));
        // What the writer does not write: a size that is an override.
        entry.workgroup_size = [WORKGROUP as u32, 1, 1];
        entry.workgroup_size_overrides = None;
    }
    let info = validate(&module);
    (write_string(&module, &info, WriterFlags::empty()).unwrap(), altered)
}
