//! Tests of whole scenes.

mod drawn;
mod solids;
mod spheres;
mod track;

mod columns;
mod definition;
mod extremes;
mod inside_reports;
mod judge;
mod laws;
mod passages;
mod reports;
mod tracking;
mod values;
