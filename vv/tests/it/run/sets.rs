//! Vertex sets as values, variables and arguments.

use super::{check, check_body};

#[test]
fn sets_iterate_in_the_order_of_addition() {
    check_body("mesh T; add c to T; add a to T; add c to T; add b to T; print T;", "{v3, v1, v2}");
    check_body("mesh T; add c to T; add a to T; remove c from T; add c to T; print T;", "{v1, v3}");
    check_body(
        "mesh T, U; add b to T; add e to U; add b to U; add a to U; merge T with U; print T; merge U with T; print U;",
        "{v2, v5, v1}\n{v5, v2, v1}",
    );
}

#[test]
fn copies_are_independent() {
    check_body(
        "mesh T; add a to T; mesh U = T; add b to U; print T, U; T = U; add c to U; print T, U;",
        "{v1}{v1, v2}\n{v1, v2}{v1, v2, v3}",
    );
}

#[test]
fn sets_are_passed_by_value_or_by_reference() {
    check(
        "static void grow(mesh T) { vertex x; add x to T; print T; }
         static void grow_it(mesh& T) { vertex x; add x to T; }
         void step(mesh& S) { grow(S); print S; grow_it(S); print S; mesh U = S; grow_it(U); print S, U; }",
        "{v1}\n{}\n{v2}\n{v2}{v2, v3}",
    );
}

#[test]
fn functions_return_sets() {
    check(
        "mesh pair(vertex a, vertex b) { mesh T; add a to T; add b to T; return T; }
         void step(mesh& S) {
           vertex a, b, c;
           mesh P = pair(a, b); print P, is a in pair(b, c);
           merge S with pair(c, a); print S;
           S = pair(b, b); print S;
           forall v in pair(a, c) print v;
           print true ? P : S;
         }",
        "{v1, v2}false\n{v3, v1}\n{v2}\nv1\nv3\n{v1, v2}",
    );
}

#[test]
fn the_rules_set_is_the_meshs() {
    let text = "void start(mesh& S) { vertex a, b, c; add c to S; add a to S; }
                void step(mesh& S) { print S; vertex d; add d to S; }";
    let (output, mesh) = super::run_with(text, 2, &vv::engine::Settings::default());
    assert_eq!(output, ["{v3, v1}", "{v3, v1, v4}"]);
    assert_eq!(mesh.set.iter().map(|v| v.to_string()).collect::<Vec<_>>(), ["v3", "v1", "v4", "v5"]);
}
