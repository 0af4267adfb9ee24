//! Numbers: int, double, vec, conversions, and how they are printed.

use super::check_body;

#[test]
fn ints() {
    check_body("print 7 / 2, -7 / 2, 7 % 3, -7 % 3, 7 % -3;", "3-31-11");
    check_body("int i = 3; print i++, i, ++i, i--, --i; i += 4; i *= 2; i -= 1; i /= 2; print i;", "34553\n6");
    check_body(
        "print 9223372036854775807 - 1 + 1, -9223372036854775807 - 1;",
        "9223372036854775807-9223372036854775808",
    );
}

#[test]
fn int_errors() {
    let check = |e: &str, place: &str, message: &str, operands: &str| {
        check_body(
            &format!("int m = 9223372036854775807, z = 0;\n{e};"),
            &format!("error 3:{place} `{}`: {message}\n= operands: {operands}", e.trim_start_matches("print ")),
        );
    };
    let overflow = "the result does not fit into an int";
    check("print m + 1", "7", overflow, "9223372036854775807, 1");
    check("print -m - 2", "7", overflow, "-9223372036854775807, 2");
    check("print m * m", "7", overflow, "9223372036854775807, 9223372036854775807");
    check("m++", "1", overflow, "9223372036854775807");
    check("m += 1", "1", overflow, "9223372036854775807, 1");
    check("print m / z", "7", "this divides by zero", "9223372036854775807, 0");
    check("print m % z", "7", "this divides by zero", "9223372036854775807, 0");
    check_body(
        "int m = -9223372036854775807 - 1; print abs(m);",
        "error 2:41 `abs(m)`: the result does not fit into an int
         = operands: -9223372036854775808",
    );
    check_body(
        "int m = -9223372036854775807 - 1; print m / -1;",
        "error 2:41 `m / -1`: the result does not fit into an int
         = operands: -9223372036854775808, -1",
    );
    check_body(
        "int m = -9223372036854775807 - 1; print -m;",
        "error 2:41 `-m`: the result does not fit into an int
         = operands: -9223372036854775808",
    );
}

#[test]
fn doubles() {
    check_body(
        "print 7 / 2.0, 1 / 3.0, 0.1 + 0.2, 1e300 * 1e10, -1 / 0.0, 1e-7;",
        "3.50.33333333333333330.30000000000000004inf-inf1e-7",
    );
    check_body("double x = 0, n = x / x; print n, n == n, n != n, n < 1, !(n < 1);", "nanfalsetruefalsetrue");
    check_body("double x = 1; print x, x++, x, --x; x /= 4; print x, -x, 0.0 * -1;", "1121\n0.25-0.25-0");
}

#[test]
fn conversions() {
    check_body(
        "int i = int(3.9); int j = int(-3.9); print i, j; i = int(i * 1.5); print i; double x = i; print x / 8;",
        "3-3\n4\n0.5",
    );
    check_body("bool x = 2; print x; int i = x; print i + 1, x ? 1 : 2, a ? 1 : 2, true + 1.5;", "true\n2112.5");
    check_body("double x = 0; int i = x / x;", "error 2:23 `x / x`: nan is no int: this does not fit into an int");
    check_body(
        "double x = 9223372036854775807.0; int i = 1; i = x;",
        "error 2:50 `x`: 9.223372036854776e18 is no int: this does not fit into an int",
    );
    check_body("double x = -9223372036854775808.0; int i = x; print i;", "-9223372036854775808");
}

#[test]
fn vectors() {
    check_body(
        "vec u = vec(1, 2, 3), v = vec(0.5, 0, -1);
         print u + v, u - v, u * 2.0, 2.0 * u, u / 2.0, -u, u == v, u != v;
         print dot(u, v), cross(u, v), length(vec(3, 4, 0)), u.x, (u + v).z;
         u.y = 7; u += v; u *= 2.0; u.x /= 3; print u;",
        "(1.5, 2, 2)(0.5, 2, 4)(2, 4, 6)(2, 4, 6)(0.5, 1, 1.5)(-1, -2, -3)falsetrue
         -2.5(-2, 2.5, -1)512
         (1, 14, 4)",
    );
}

#[test]
fn logic_computes_no_more_than_it_needs() {
    super::check(
        "bool say(bool b) { print b; return b; }
         void step(mesh& S) {
           print say(false) && say(true); print say(true) || say(false);
           print say(true) && say(false); print say(true) ? 1 : 2;
         }",
        "false\nfalse\ntrue\ntrue\ntrue\nfalse\nfalse\ntrue\n1",
    );
}
