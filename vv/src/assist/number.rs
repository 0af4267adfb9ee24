//! Numbers in a text, to be changed in place.

use std::ops::Range;

use crate::syntax::{TokenClass, highlight};

/// A number as it is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Number {
    /// Where; with its sign.
    pub range: Range<usize>,
    /// In units of its last digit.
    units: i64,
    /// Digits behind the point; `None` for whole numbers.
    decimals: Option<usize>,
    /// From `e` on.
    exponent: String,
    /// Below zero it would run together with the sign before it.
    stays_positive: bool,
}

/// The number at a place, or that ends there. `None` also for one of more digits than can be counted with.
#[must_use]
pub fn number_at(text: &str, at: usize) -> Option<Number> {
    let tokens = highlight(text);
    let i = tokens.iter().position(|(r, class)| *class == TokenClass::Literal && r.start <= at && at <= r.end)?;
    let range = tokens[i].0.clone();
    let written = &text[range.clone()];
    let mantissa_end = written.find(['e', 'E']).unwrap_or(written.len());
    let (mantissa, exponent) = written.split_at(mantissa_end);
    let (whole, fraction) = mantissa.split_once('.').map_or((mantissa, None), |(w, f)| (w, Some(f)));
    if !mantissa.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    // A point wants a digit behind it.
    let decimals = fraction.map(|f| f.len().max(1));
    let digits = format!("{whole}{}", if fraction == Some("") { "0" } else { fraction.unwrap_or("") });
    let units = digits.parse().ok().filter(|units: &i64| *units < 1 << 53)?;
    let sign = |j: usize| matches!(&text[tokens[j].0.clone()], "-" | "−" | "–");
    let is_value = |j: usize| {
        let (range, class) = &tokens[j];
        matches!(class, TokenClass::Name | TokenClass::Literal | TokenClass::Property)
            || matches!(&text[range.clone()], ")" | "]")
    };
    let touches = i > 0 && tokens[i - 1].0.end == range.start;
    if touches && sign(i - 1) && (i == 1 || !is_value(i - 2)) {
        let range = tokens[i - 1].0.start..range.end;
        return Some(Number { range, units: -units, decimals, exponent: exponent.to_owned(), stays_positive: false });
    }
    let stays_positive = touches && matches!(&text[tokens[i - 1].0.clone()], "-" | "+" | "−" | "–");
    Some(Number { range, units, decimals, exponent: exponent.to_owned(), stays_positive })
}

impl Number {
    /// The number so many units of its last digit further, written with as many digits.
    #[must_use]
    pub fn moved(&self, units: i64) -> String {
        let units = self.units.saturating_add(units);
        let units = if self.stays_positive { units.max(0) } else { units };
        let sign = if units < 0 { "-" } else { "" };
        let digits = units.unsigned_abs().to_string();
        let number = match self.decimals {
            None => digits,
            Some(decimals) => {
                let digits = format!("{digits:0>width$}", width = decimals + 1);
                let (whole, fraction) = digits.split_at(digits.len() - decimals);
                format!("{whole}.{fraction}")
            }
        };
        format!("{sign}{number}{}", self.exponent)
    }
}
