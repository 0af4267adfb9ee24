//! Habits of C++, of mathematics and of other languages.

use super::{check, check_file};

#[test]
fn for_in_place_of_forall() {
    check(
        r#"
        for (vertex p : S) { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for (p in S) { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for p in S { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for (auto p : S) a;
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
    "#,
    );
}

#[test]
fn assignment_as_condition() {
    check(
        r#"
        if (a = b) c;
        //  ^^^^^ warning: this condition stores a value, it does not compare | compare with `==`
        while (p = q) c;
        //     ^^^^^ warning: this condition stores a value, it does not compare | compare with `==`
        double x == 3;
        //       ^^ error: expected `=`, found `==` | write `=`
    "#,
    );
}

#[test]
fn operators_of_mathematics() {
    check(
        r#"
        if (a < b < c) d;
        //        ^ error: comparisons cannot be chained | write `a < b && b < c`
        a =< b;
        // ^ error: expected a value, found `<` | write `<=`
        a => b;
        // ^ error: expected a value, found `>` | write `>=`
        a = b === c;
        //      ^ error: expected a value, found `=` | write `==` or `!=`
        if (a and b or c && not d) e;
        //    ^^^ error: expected an operator, found `and` | write `&&`
        //          ^^ error: expected an operator, found `or` | write `||`
        //                  ^^^ error: unknown word `not` | write `!`
    "#,
    );
}

#[test]
fn casts() {
    check(
        r#"
        double x = (double)n / (int)(a + b);
        //         ^^^^^^^^^ error: vv converts as a call does, not by a cast | write `double(n)`
        //                     ^^^^^^^^^^^^ error: vv converts as a call does, not by a cast | write `int(a + b)`
    "#,
    );
}

#[test]
fn foreign_types() {
    check(
        r#"
        float x = 1.0;
      //^^^^^ error: `float` is not a type of vv | write `double`
        auto p = any in v;
      //^^^^ error: vv has no `auto`, a variable is declared with its type | probably `vertex`
        size_t i = 0;
      //^^^^^^ error: `size_t` is not a type of vv | write `int`
        unsigned n;
      //^^^^^^^^ error: `unsigned` is not a type of vv | write `int`
        Foo y = 3;
      //^^^ error: `Foo` is not a type of vv | the types are `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`
        foo z;
      //^^^ error: `foo` is not a type of vv | the types are `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`
    "#,
    );
}

#[test]
fn arrays() {
    check(
        r#"
        double a[3];
        //      ^ error: vv has no arrays | keep values as properties: `vertex { double age = 0; };` and `v$age`
        a[0] = 1;
       //^ error: expected an operator, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
        x = a[i] + b;
        //   ^ error: expected an operator, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
        vec v = {1, 2, 3};
        //      ^ error: expected a value, found `{` | a vector is written `vec(x, y, z)`
    "#,
    );
}

#[test]
fn pointers_and_references() {
    check(
        r#"
        vertex& q = p;
        //    ^ error: vv has no variables that refer to others | leave it out: a vertex is a handle already
        vertex* r = p;
        //    ^ error: vv has no pointers | leave it out: a vertex is a handle already
        q->pos = p$pos;
       //^^ error: vv has no pointers, so no `->` | properties are written `v$name`
        x = &p;
        //  ^ error: expected a value, found `&` | write `&&` for and; vv has no bit operations and no addresses
    "#,
    );
}

#[test]
fn standard_library() {
    check(
        r#"
        x = std::sqrt(2.0);
        //  ^^^^^ error: vv has no namespaces: its functions are there without a prefix | leave it out
        std::cout << x << y;
      //^^^ error: vv writes with `print` | write `print "n = ", n;`
        std::vector<vertex> v;
      //^^^ error: vv has no containers | sets of vertices are of type `mesh`; values are kept as properties: `v$name`
        cout << x;
      //^^^^ error: vv writes with `print` | write `print "n = ", n;`
        printf("%d", n);
      //^^^^^^ error: vv writes with `print` | write `print "n = ", n;`
    "#,
    );
}

#[test]
fn foreign_statements() {
    check(
        r#"
        switch (x) { case 1: a; break; default: b; }
      //^^^^^^ error: vv has no `switch` | write `if … else if … else …`
        b;
        try { a; } catch (e) { b; }
      //^^^ error: vv has no exceptions | every error ends the step and leaves the mesh as it was before
        throw x;
      //^^^^^ error: vv has no exceptions | every error ends the step and leaves the mesh as it was before
        goto end;
      //^^^^ error: vv has no `goto` | leave loops with `break` or `return`
        assert x;
      //^^^^^^ error: vv has no `assert` | write `if (!condition) print "…";`
    "#,
    );
}

#[test]
fn bit_operations() {
    check(
        r#"
        x = a & b;
        //    ^ error: expected `;`, found `&` | write `&&` for and; vv has no bit operations and no addresses
        x = a | b;
        //    ^ error: expected `;`, found `|` | an edge is written `(p|q)`, with parentheses; vv has no bit operations
        x = a << 2;
        //    ^^ error: expected `;`, found `<<` | write `print a, b;`; vv has no bit operations
        x = a ^ b;
        //    ^ error: expected `;`, found `^` | vv has no bit operations; powers are written `pow(x, 2.0)`
        x = ~a;
        //  ^ error: expected a value, found `~` | vv has no bit operations; powers are written `pow(x, 2.0)`
    "#,
    );
}

#[test]
fn further_cpp() {
    check(
        r#"
        string s = "a";
      //^^^^^^ error: vv has no variables for text | strings stand in `print` only
        char c = 'a';
      //^^^^ error: vv has no variables for text | strings stand in `print` only
        x = nullptr;
        //  ^^^^^^^ error: `nullptr` is `null` in vv | write `null`
        static int n = 0;
      //^^^^^^ error: vv has no static variables, they would survive an undo | keep state as a property of the mesh: `mesh { int generation = 0; };`
        new p;
      //^^^ error: vv has neither `new` nor `delete` | `vertex v;` creates a vertex; a vertex that no mesh holds is forgotten
        x = new p;
        //  ^^^ error: vv has neither `new` nor `delete` | `vertex v;` creates a vertex; a vertex that no mesh holds is forgotten
        int i = 0, double y;
        //         ^^^^^^ error: the type stands once, before the first of several variables | leave it out
    "#,
    );
}

#[test]
fn constructors_and_lambdas() {
    check(
        r#"
        int n(1, 2);
        //   ^^^^^^ error: `n` takes one value, not 2 | write `type name = value;`
        auto f = [](vertex v) { return v; };
        //       ^ error: expected a value, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
    "#,
    );
}

#[test]
fn preprocessor() {
    check_file(
        r#"
    #include <cmath>
  //^^^^^^^^^^^^^^^^ error: vv has no header files, its functions are built in | leave this line out
    #include insert.vv
  //^^^^^^^^^^^^^^^^^^ error: expected a file name in quotes after `#include` | write it in quotes
    #include
  //^^^^^^^^ error: expected a file name in quotes after `#include` | write `#include "insert.vv"`
    #define K 3
  //^^^^^^^^^^^ error: vv has no macros | write `const double k = 0.5;`, or `param` for a slider
    #pragma once
  //^^^^^^^^^^^^ error: vv has no preprocessor but `#include "file.vv"` | leave this line out
    void f() { }
"#,
    );
}

#[test]
fn types_of_ones_own() {
    check_file(
        r#"
    struct A { int x; };
  //^^^^^^ error: vv has no types of one's own | values are kept as properties: `vertex { double age = 0; };` and `v$age`
    template <class T> void f(T x) { }
  //^^^^^^^^ error: vv has no templates | write one function for each type
    using namespace std;
  //^^^^^ error: vv has neither namespaces nor type names of one's own | leave this line out
    class B;
  //^^^^^ error: vv has no types of one's own | values are kept as properties: `vertex { double age = 0; };` and `v$age`
    void g() { }
"#,
    );
}

#[test]
fn automatic_types() {
    check_file(
        r#"
    void f() {
      auto n = valence p;
    //^^^^ error: vv has no `auto`, a variable is declared with its type | probably `int`
      auto v = p$pos + q$pos;
    //^^^^ error: vv has no `auto`, a variable is declared with its type | probably `vec`
      auto f = [](vertex v) { return v; };
      //       ^ error: expected a value, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
      auto g;
    //^^^^ error: vv has no `auto`, a variable is declared with its type | write `double x = …`, `vertex v = …`
      let x = 3;
    //^^^ error: vv has no `let`, a variable is declared with its type | probably `int`
    }
"#,
    );
}

#[test]
fn other_words_of_cpp_inside_values() {
    check(
        r#"
        vertex a = new vertex;
        //         ^^^ error: vv has neither `new` nor `delete` | `vertex v;` creates a vertex; a vertex that no mesh holds is forgotten
        int i = static_cast<int>(2.5);
        //      ^^^^^^^^^^^ error: vv converts as a call does, not by a cast | write `int(x)` or `double(n)`
    "#,
    );
}
