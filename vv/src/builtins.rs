//! The functions of the language: one table of name, signature, documentation and the Rust function that every engine
//! calls.
//!
//! Elementary functions come from the `libm` crate, so that every machine gives the same bits. A name may have several
//! rows, for different types of arguments.

use std::fmt;

use glam::DVec3;

use crate::mesh::{Type, Value};

/// A function of the language: a row of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Builtin(u16);

impl Builtin {
    /// All of them, in the order of the table: those of one name stand together.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..TABLE.len() as u16).map(Self)
    }

    /// Those of a name.
    pub fn named(name: &str) -> impl Iterator<Item = Self> {
        Self::all().filter(move |b| b.name() == name)
    }

    fn row(self) -> &'static Row {
        &TABLE[self.0 as usize]
    }

    /// What calls use.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// What it does, in one line.
    #[must_use]
    pub fn doc(self) -> &'static str {
        self.row().doc
    }

    /// What to call.
    #[must_use]
    pub fn code(self) -> Code {
        self.row().code
    }

    /// Types of its arguments.
    #[must_use]
    pub fn parameters(self) -> &'static [Type] {
        self.row().code.types().0
    }

    /// Type of its result.
    #[must_use]
    pub fn returns(self) -> Type {
        self.row().code.types().1
    }

    /// Calls it. `None` if an int overflows, or if there are not as many arguments as [`Builtin::parameters`] says, of
    /// those types.
    #[must_use]
    pub fn apply(self, arguments: &[Value], random: &mut Random) -> Option<Value> {
        use Value::{Double, Int, Vec};
        Some(match (self.code(), arguments) {
            (Code::D1(f), &[Double(x)]) => Double(f(x)),
            (Code::D2(f), &[Double(x), Double(y)]) => Double(f(x, y)),
            (Code::D3(f), &[Double(x), Double(y), Double(z)]) => Double(f(x, y, z)),
            (Code::I1(f), &[Int(x)]) => Int(f(x)?),
            (Code::I2(f), &[Int(x), Int(y)]) => Int(f(x, y)),
            (Code::I3(f), &[Int(x), Int(y), Int(z)]) => Int(f(x, y, z)),
            (Code::VecFromD3(f), &[Double(x), Double(y), Double(z)]) => Vec(f(x, y, z)),
            (Code::DFromVec1(f), &[Vec(a)]) => Double(f(a)),
            (Code::DFromVec2(f), &[Vec(a), Vec(b)]) => Double(f(a, b)),
            (Code::Vec1(f), &[Vec(a)]) => Vec(f(a)),
            (Code::Vec2(f), &[Vec(a), Vec(b)]) => Vec(f(a, b)),
            (Code::Random, &[]) => Double(random.unit()),
            (Code::RandomBetween, &[Double(low), Double(high)]) => Double(random.between(low, high)),
            _ => return None,
        })
    }
}

/// The signature, as in `double pow(double base, double exponent)`.
impl fmt::Display for Builtin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}(", type_name(self.returns()), self.name())?;
        for (i, (ty, name)) in self.parameters().iter().zip(self.row().parameters).enumerate() {
            let comma = if i > 0 { ", " } else { "" };
            write!(f, "{comma}{} {name}", type_name(*ty))?;
        }
        f.write_str(")")
    }
}

/// What a type is called in programs.
#[must_use]
pub fn type_name(ty: Type) -> &'static str {
    match ty {
        Type::Bool => "bool",
        Type::Int => "int",
        Type::Double => "double",
        Type::Vec => "vec",
        Type::Vertex => "vertex",
    }
}

/// The Rust function behind a name, by its types: D is `double`, I is `int`, Vec is `vec`; the number counts arguments.
#[derive(Debug, Clone, Copy)]
#[expect(missing_docs, reason = "each is a function of the types in its name")]
pub enum Code {
    D1(fn(f64) -> f64),
    D2(fn(f64, f64) -> f64),
    D3(fn(f64, f64, f64) -> f64),
    /// `None` where the result overflows, which is an error.
    I1(fn(i64) -> Option<i64>),
    I2(fn(i64, i64) -> i64),
    I3(fn(i64, i64, i64) -> i64),
    VecFromD3(fn(f64, f64, f64) -> DVec3),
    DFromVec1(fn(DVec3) -> f64),
    DFromVec2(fn(DVec3, DVec3) -> f64),
    Vec1(fn(DVec3) -> DVec3),
    Vec2(fn(DVec3, DVec3) -> DVec3),
    /// [`Random::unit`] of the run's generator.
    Random,
    /// [`Random::between`] of the run's generator.
    RandomBetween,
}

impl Code {
    fn types(self) -> (&'static [Type], Type) {
        use Type::{Double, Int, Vec};
        match self {
            Self::D1(_) => (&[Double], Double),
            Self::D2(_) | Self::RandomBetween => (&[Double, Double], Double),
            Self::D3(_) => (&[Double, Double, Double], Double),
            Self::I1(_) => (&[Int], Int),
            Self::I2(_) => (&[Int, Int], Int),
            Self::I3(_) => (&[Int, Int, Int], Int),
            Self::VecFromD3(_) => (&[Double, Double, Double], Vec),
            Self::DFromVec1(_) => (&[Vec], Double),
            Self::DFromVec2(_) => (&[Vec, Vec], Double),
            Self::Vec1(_) => (&[Vec], Vec),
            Self::Vec2(_) => (&[Vec, Vec], Vec),
            Self::Random => (&[], Double),
        }
    }
}

/// The generator behind `random()`: xoshiro256++ 1.0 (Blackman, Vigna 2019), its state filled by splitmix64. The same
/// seed and generation give the same stream on every machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Random([u64; 4]);

impl Random {
    /// The stream of a step.
    #[must_use]
    pub fn new(seed: u64, generation: u64) -> Self {
        let mut state = seed;
        // Mixed first, so that (1, 0) and (0, 1) are different streams.
        state = splitmix64(&mut state) ^ generation;
        Self(std::array::from_fn(|_| splitmix64(&mut state)))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        let s = &mut self.0;
        let result = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(45);
        result
    }

    /// A multiple of 2⁻⁵³ in [0, 1), each as likely.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * f64::EPSILON / 2.0
    }

    /// `low + (high − low)·unit()`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

fn splitmix64(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A named number.
#[derive(Debug, Clone, Copy)]
pub struct NamedNumber {
    /// Its name.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// What it is, in one line.
    pub doc: &'static str,
}

/// The numbers that have names.
pub const NUMBERS: &[NamedNumber] = &[
    NamedNumber { name: "tau", value: std::f64::consts::TAU, doc: "a full turn in radians, 2π" },
    NamedNumber { name: "pi", value: std::f64::consts::PI, doc: "half a turn in radians, π" },
];

struct Row {
    name: &'static str,
    parameters: &'static [&'static str],
    code: Code,
    doc: &'static str,
}

const fn row(name: &'static str, parameters: &'static [&'static str], code: Code, doc: &'static str) -> Row {
    Row { name, parameters, code, doc }
}

const X: &[&str] = &["x"];
const AB: &[&str] = &["a", "b"];
const RANGE: &[&str] = &["x", "low", "high"];

static TABLE: &[Row] = &[
    row("sin", X, Code::D1(libm::sin), "sine of an angle in radians"),
    row("cos", X, Code::D1(libm::cos), "cosine of an angle in radians"),
    row("tan", X, Code::D1(libm::tan), "tangent of an angle in radians"),
    row("asin", X, Code::D1(libm::asin), "angle whose sine is x, in [-tau/4, tau/4]"),
    row("acos", X, Code::D1(libm::acos), "angle whose cosine is x, in [0, tau/2]"),
    row("atan", X, Code::D1(libm::atan), "angle whose tangent is x, in [-tau/4, tau/4]"),
    row("atan2", &["y", "x"], Code::D2(libm::atan2), "angle of the point (x, y), in [-tau/2, tau/2]"),
    row("sinh", X, Code::D1(libm::sinh), "hyperbolic sine"),
    row("cosh", X, Code::D1(libm::cosh), "hyperbolic cosine"),
    row("tanh", X, Code::D1(libm::tanh), "hyperbolic tangent"),
    row("asinh", X, Code::D1(libm::asinh), "inverse of sinh"),
    row("acosh", X, Code::D1(libm::acosh), "inverse of cosh, not negative"),
    row("atanh", X, Code::D1(libm::atanh), "inverse of tanh"),
    row("exp", X, Code::D1(libm::exp), "e to the power x"),
    row("exp2", X, Code::D1(libm::exp2), "2 to the power x"),
    row("expm1", X, Code::D1(libm::expm1), "exp(x) - 1, exact for small x"),
    row("log", X, Code::D1(libm::log), "natural logarithm"),
    row("log2", X, Code::D1(libm::log2), "logarithm to base 2"),
    row("log10", X, Code::D1(libm::log10), "logarithm to base 10"),
    row("log1p", X, Code::D1(libm::log1p), "log(1 + x), exact for small x"),
    row("pow", &["base", "exponent"], Code::D2(libm::pow), "base to the power exponent"),
    row("sqrt", X, Code::D1(libm::sqrt), "square root, NaN for negative x"),
    row("cbrt", X, Code::D1(libm::cbrt), "cube root"),
    row("hypot", AB, Code::D2(libm::hypot), "square root of a*a + b*b"),
    row("floor", X, Code::D1(libm::floor), "the largest whole number not above x"),
    row("ceil", X, Code::D1(libm::ceil), "the smallest whole number not below x"),
    row("round", X, Code::D1(libm::round), "the nearest whole number, halves away from zero"),
    row("trunc", X, Code::D1(libm::trunc), "x without its fraction"),
    row("fabs", X, Code::D1(libm::fabs), "x without its sign"),
    row("fmod", AB, Code::D2(libm::fmod), "remainder of a / b, with the sign of a"),
    row("fmin", AB, Code::D2(libm::fmin), "the smaller; where one is NaN, the other"),
    row("fmax", AB, Code::D2(libm::fmax), "the larger; where one is NaN, the other"),
    row("abs", X, Code::I1(i64::checked_abs), "x without its sign"),
    row("abs", X, Code::D1(libm::fabs), "x without its sign"),
    row("min", AB, Code::I2(|a, b| if b < a { b } else { a }), "the smaller"),
    row("min", AB, Code::D2(|a, b| if b < a { b } else { a }), "b if b < a, else a"),
    row("max", AB, Code::I2(|a, b| if a < b { b } else { a }), "the larger"),
    row("max", AB, Code::D2(|a, b| if a < b { b } else { a }), "b if a < b, else a"),
    row("clamp", RANGE, Code::I3(clamp), "low if x < low, else high if x > high, else x"),
    row("clamp", RANGE, Code::D3(clamp), "low if x < low, else high if x > high, else x"),
    row("random", &[], Code::Random, "a random number in [0, 1), the same for the same seed and generation"),
    row("random", &["low", "high"], Code::RandomBetween, "low + (high - low) * random()"),
    row("vec", &["x", "y", "z"], Code::VecFromD3(DVec3::new), "the vector or position with these coordinates"),
    row("dot", AB, Code::DFromVec2(dot), "scalar product"),
    row("cross", AB, Code::Vec2(cross), "vector product"),
    row("length", &["v"], Code::DFromVec1(length), "square root of dot(v, v)"),
    row("distance", AB, Code::DFromVec2(|a, b| length(a - b)), "length(a - b)"),
    row("normalize", &["v"], Code::Vec1(normalize), "v / length(v); the zero vector where that length is 0"),
];

fn clamp<T: PartialOrd>(x: T, low: T, high: T) -> T {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

// Written out, so that the order of operations is this one whatever the vector library does.
fn dot(a: DVec3, b: DVec3) -> f64 {
    (a.x * b.x + a.y * b.y) + a.z * b.z
}

fn cross(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

fn length(v: DVec3) -> f64 {
    libm::sqrt(dot(v, v))
}

fn normalize(v: DVec3) -> DVec3 {
    let length = length(v);
    if length == 0.0 { DVec3::ZERO } else { DVec3::new(v.x / length, v.y / length, v.z / length) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(name: &str, arguments: &[Value]) -> Option<Value> {
        let types: Vec<Type> = arguments.iter().map(|v| v.ty()).collect();
        let builtin = Builtin::named(name).find(|b| b.parameters() == types).expect("a row with these types");
        builtin.apply(arguments, &mut Random::new(1, 0))
    }

    #[track_caller]
    fn check(name: &str, arguments: &[Value], expected: Value) {
        assert_eq!(call(name, arguments), Some(expected));
    }

    #[test]
    fn rows_of_a_name_differ_in_their_types_and_every_parameter_has_a_name() {
        let all: Vec<Builtin> = Builtin::all().collect();
        for (i, a) in all.iter().enumerate() {
            assert_eq!(a.parameters().len(), a.row().parameters.len(), "{a}");
            for b in &all[..i] {
                assert!(a.name() != b.name() || a.parameters() != b.parameters(), "{a} and {b}");
            }
        }
    }

    #[test]
    fn signatures_read_as_declarations() {
        let lines: Vec<String> =
            ["pow", "random", "normalize"].into_iter().flat_map(Builtin::named).map(|b| b.to_string()).collect();
        assert_eq!(
            lines,
            [
                "double pow(double base, double exponent)",
                "double random()",
                "double random(double low, double high)",
                "vec normalize(vec v)"
            ]
        );
    }

    #[test]
    fn vectors() {
        let (x, y) = (Value::Vec(DVec3::X), Value::Vec(DVec3::Y));
        check("cross", &[x, y], Value::Vec(DVec3::Z));
        check("dot", &[x, y], Value::Double(0.0));
        check("distance", &[x, y], Value::Double(std::f64::consts::SQRT_2));
        check("normalize", &[Value::Vec(DVec3::new(0.0, 3.0, 4.0))], Value::Vec(DVec3::new(0.0, 0.6, 0.8)));
    }

    #[test]
    fn the_zero_vector_stays_zero_when_normalized() {
        check("normalize", &[Value::Vec(DVec3::ZERO)], Value::Vec(DVec3::ZERO));
        check("normalize", &[Value::Vec(DVec3::splat(1e-200))], Value::Vec(DVec3::ZERO));
    }

    #[test]
    fn int_functions_do_not_overflow_silently() {
        check("abs", &[Value::Int(-3)], Value::Int(3));
        assert_eq!(call("abs", &[Value::Int(i64::MIN)]), None);
    }

    #[test]
    fn arguments_of_other_types_give_nothing() {
        let pow = Builtin::named("pow").next().expect("pow");
        assert_eq!(pow.apply(&[Value::Int(2), Value::Int(3)], &mut Random::new(0, 0)), None);
    }

    #[test]
    fn random_numbers_follow_from_seed_and_generation() {
        let stream = |seed, generation| {
            let mut random = Random::new(seed, generation);
            std::array::from_fn::<_, 4, _>(|_| random.bits())
        };
        assert_eq!(stream(7, 3), stream(7, 3));
        let all = [stream(0, 0), stream(0, 1), stream(1, 0), stream(1, 1)];
        for (i, a) in all.iter().enumerate() {
            assert!(!all[..i].contains(a));
        }
    }

    /// The first output for the state 1, 2, 3, 4 follows from the definition: rotl(1 + 4, 23) + 1.
    #[test]
    fn the_generator_is_xoshiro256_plus_plus() {
        let mut random = Random([1, 2, 3, 4]);
        let first: Vec<u64> = (0..3).map(|_| random.bits()).collect();
        assert_eq!(first, [41_943_041, 58_720_359, 3_588_806_011_781_223]);
    }

    #[test]
    fn random_units_fill_the_interval() {
        let mut random = Random::new(42, 1);
        let mean = (0..10_000).map(|_| random.unit()).inspect(|x| assert!((0.0..1.0).contains(x))).sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
    }
}
