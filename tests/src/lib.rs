//! Helpers shared by the test programs of kibiray.
