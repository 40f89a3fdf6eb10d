//! Tests of whole scenes.

mod drawn;
mod solids;

mod definition;
mod extremes;
mod judge;
mod laws;
mod passages;
mod reports;
mod values;
