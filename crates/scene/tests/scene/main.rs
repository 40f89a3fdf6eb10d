//! Tests of whole scenes.

mod drawn;
mod instanced;
mod solids;
mod spheres;
mod track;

mod columns;
mod definition;
mod extremes;
mod inside_reports;
mod instances;
mod judge;
mod judge_hits;
mod laws;
mod passages;
mod reports;
mod tracking;
mod values;
