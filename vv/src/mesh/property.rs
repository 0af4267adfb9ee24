//! Named values that vertices, edges and meshes carry beside their positions.

use glam::DVec3;

use super::{Column, Vertex};

/// Doubles below this that are whole are ints.
const WHOLE: f64 = (1i64 << 62) as f64;

/// The types of the values a program computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Type {
    /// `bool`
    Bool,
    /// `int`: 64 bits, overflow is an error.
    Int,
    /// `double`
    Double,
    /// `vec`, also called `point` and `vector`.
    Vec,
    /// `vertex`: a vertex or null.
    Vertex,
}

/// A value that a property can hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// `bool`
    Bool(bool),
    /// `int`
    Int(i64),
    /// `double`
    Double(f64),
    /// `vec`
    Vec(DVec3),
    /// `vertex`, `None` is null.
    Vertex(Option<Vertex>),
}

impl Value {
    /// The type of a property or variable that can hold it.
    #[must_use]
    pub fn ty(self) -> Type {
        match self {
            Self::Bool(_) => Type::Bool,
            Self::Int(_) => Type::Int,
            Self::Double(_) => Type::Double,
            Self::Vec(_) => Type::Vec,
            Self::Vertex(_) => Type::Vertex,
        }
    }

    /// What a variable of this type holds before anything is stored: false, 0, the origin, null.
    #[must_use]
    pub fn zero(ty: Type) -> Self {
        match ty {
            Type::Bool => Self::Bool(false),
            Type::Int => Self::Int(0),
            Type::Double => Self::Double(0.0),
            Type::Vec => Self::Vec(DVec3::ZERO),
            Type::Vertex => Self::Vertex(None),
        }
    }
}

/// A column of one type.
#[derive(Debug, Clone)]
pub enum Values {
    /// `bool`
    Bool(Column<bool>),
    /// `int`
    Int(Column<i64>),
    /// `double`
    Double(Column<f64>),
    /// `vec`
    Vec(Column<DVec3>),
    /// `vertex`
    Vertex(Column<Option<Vertex>>),
}

/// Runs `$body` with `$column` bound to the typed column inside `$values`.
macro_rules! on_column {
    ($values:expr, $column:ident => $body:expr) => {
        match $values {
            Values::Bool($column) => $body,
            Values::Int($column) => $body,
            Values::Double($column) => $body,
            Values::Vec($column) => $body,
            Values::Vertex($column) => $body,
        }
    };
}

impl Values {
    /// `n` times the same value.
    #[must_use]
    pub fn filled(value: Value, n: usize) -> Self {
        match value {
            Value::Bool(x) => Self::Bool(vec![x; n].into()),
            Value::Int(x) => Self::Int(vec![x; n].into()),
            Value::Double(x) => Self::Double(vec![x; n].into()),
            Value::Vec(x) => Self::Vec(vec![x; n].into()),
            Value::Vertex(x) => Self::Vertex(vec![x; n].into()),
        }
    }

    /// The type of every value.
    #[must_use]
    pub fn ty(&self) -> Type {
        match self {
            Self::Bool(_) => Type::Bool,
            Self::Int(_) => Type::Int,
            Self::Double(_) => Type::Double,
            Self::Vec(_) => Type::Vec,
            Self::Vertex(_) => Type::Vertex,
        }
    }

    /// How many values: one for each vertex, or for edges one for each slot of the rings.
    #[must_use]
    pub fn len(&self) -> usize {
        on_column!(self, c => c.len())
    }

    /// Whether it has no value, as in a mesh without vertices.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes of the array.
    #[must_use]
    pub fn bytes(&self) -> usize {
        on_column!(self, c => c.bytes())
    }

    /// The value at `index`, `None` past the end.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Value> {
        Some(match self {
            Self::Bool(c) => Value::Bool(*c.get(index)?),
            Self::Int(c) => Value::Int(*c.get(index)?),
            Self::Double(c) => Value::Double(*c.get(index)?),
            Self::Vec(c) => Value::Vec(*c.get(index)?),
            Self::Vertex(c) => Value::Vertex(*c.get(index)?),
        })
    }

    /// Stores a value; no effect past the end or for a value of another type.
    pub fn set(&mut self, index: usize, value: Value) {
        fn put<T: Clone + Send>(column: &mut Column<T>, index: usize, value: T) {
            if let Some(slot) = column.edit().get_mut(index) {
                *slot = value;
            }
        }
        match (self, value) {
            (Self::Bool(c), Value::Bool(x)) => put(c, index, x),
            (Self::Int(c), Value::Int(x)) => put(c, index, x),
            (Self::Double(c), Value::Double(x)) => put(c, index, x),
            (Self::Vec(c), Value::Vec(x)) => put(c, index, x),
            (Self::Vertex(c), Value::Vertex(x)) => put(c, index, x),
            _ => {}
        }
    }

    /// Appends a value; no effect for a value of another type.
    pub fn push(&mut self, value: Value) {
        match (self, value) {
            (Self::Bool(c), Value::Bool(x)) => c.edit().push(x),
            (Self::Int(c), Value::Int(x)) => c.edit().push(x),
            (Self::Double(c), Value::Double(x)) => c.edit().push(x),
            (Self::Vec(c), Value::Vec(x)) => c.edit().push(x),
            (Self::Vertex(c), Value::Vertex(x)) => c.edit().push(x),
            _ => {}
        }
    }

    /// The values at these indices, `fill` for those past the end; it is of the same type.
    pub(super) fn gather(&self, indices: &[u32], fill: Value) -> Self {
        let mut gathered = Self::filled(fill, 0);
        for &i in indices {
            gathered.push(self.get(i as usize).unwrap_or(fill));
        }
        gathered
    }

    /// The same numbers in another type, if it can hold every one of them: an int as a double, whole doubles as ints,
    /// zeros and ones as bools. Other types are not converted.
    #[must_use]
    pub fn converted(&self, to: Type) -> Option<Self> {
        fn each<T: Send, U: Send>(column: &Column<T>, convert: impl Fn(&T) -> Option<U>) -> Option<Column<U>> {
            column.iter().map(convert).collect::<Option<Vec<_>>>().map(Column::from)
        }
        let whole = |x: &f64| (*x == x.trunc() && x.abs() < WHOLE).then_some(*x as i64);
        let flag = |x: i64| (x == 0 || x == 1).then_some(x == 1);
        Some(match (self, to) {
            (Self::Int(c), Type::Double) => Self::Double(each(c, |&x| Some(x as f64))?),
            (Self::Double(c), Type::Int) => Self::Int(each(c, whole)?),
            (Self::Int(c), Type::Bool) => Self::Bool(each(c, |&x| flag(x))?),
            (Self::Double(c), Type::Bool) => Self::Bool(each(c, |x| whole(x).and_then(flag))?),
            _ => return None,
        })
    }

    /// The values whose flag is set.
    pub(super) fn keep(&self, flags: &[bool]) -> Self {
        fn kept<T: Clone + Send>(c: &Column<T>, flags: &[bool]) -> Column<T> {
            c.iter().zip(flags).filter(|&(_, &keep)| keep).map(|(x, _)| x.clone()).collect::<Vec<_>>().into()
        }
        match self {
            Self::Bool(c) => Self::Bool(kept(c, flags)),
            Self::Int(c) => Self::Int(kept(c, flags)),
            Self::Double(c) => Self::Double(kept(c, flags)),
            Self::Vec(c) => Self::Vec(kept(c, flags)),
            Self::Vertex(c) => Self::Vertex(kept(c, flags)),
        }
    }

    /// The values but for the first `n`.
    pub(super) fn drop_first(&mut self, n: usize) {
        on_column!(self, c => c.drop_first(n));
    }

    /// Renames the vertices in a column of vertices.
    pub(super) fn rename(&mut self, name: &dyn Fn(Vertex) -> Option<Vertex>) {
        if let Self::Vertex(c) = self {
            for v in c.edit() {
                *v = v.and_then(name);
            }
        }
    }

    pub(crate) fn resize(&mut self, n: usize, fill: Value) {
        match (self, fill) {
            (Self::Bool(c), Value::Bool(x)) => c.edit().resize(n, x),
            (Self::Int(c), Value::Int(x)) => c.edit().resize(n, x),
            (Self::Double(c), Value::Double(x)) => c.edit().resize(n, x),
            (Self::Vec(c), Value::Vec(x)) => c.edit().resize(n, x),
            (Self::Vertex(c), Value::Vertex(x)) => c.edit().resize(n, x),
            _ => {}
        }
    }
}

/// A named column with the value that new elements get.
#[derive(Debug, Clone)]
pub struct Property {
    /// What stands after `$`.
    pub name: String,
    /// What a new element gets.
    pub default: Value,
    /// One value per element.
    pub values: Values,
}

pub(super) fn declare(properties: &mut Vec<Property>, name: &str, default: Value, n: usize) -> usize {
    if let Some(i) = properties.iter().position(|p| p.name == name) {
        let property = &mut properties[i];
        property.default = default;
        let ty = default.ty();
        if property.values.ty() != ty {
            property.values = property.values.converted(ty).unwrap_or_else(|| Values::filled(default, n));
        }
        return i;
    }
    properties.push(Property { name: name.to_owned(), default, values: Values::filled(default, n) });
    properties.len() - 1
}
