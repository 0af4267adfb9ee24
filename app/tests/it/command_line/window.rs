//! Opening the modeler.

use super::*;

#[cfg(target_os = "linux")]
#[test]
fn without_a_display_it_names_the_way_that_needs_none() {
    check("", 6, "there is no display to open a window on\nWAYLAND_DISPLAY nor DISPLAY\nvv run");
    check("square.off move.vv", 6, "vv run");
}

#[test]
fn what_cannot_be_opened_is_said_before() {
    check("none.vv", 3, "none.vv: there is no such file");
    check("move.vv triangle.vv", 2, "move.vv and triangle.vv are both a program: vv opens one");
    check(
        "chek move.vv",
        2,
        "`chek` is neither a program (.vv) nor a project (.vvp) nor a mesh nor a command\n`vv check`",
    );
    check("rendr move.vv", 2, "`vv render`");
    check("bicycle", 2, "the commands are `run`, `watch`, `render`, `check`, ");
}
