//! Nothing but a place for the tests in `tests/`, which need more than one crate of the workspace.
