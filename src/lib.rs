//! stub
pub mod arith;
pub mod case;
pub mod contract;
pub mod corpus;
pub mod kernel;
pub mod truth;
