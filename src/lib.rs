//! stub
pub mod arith;
pub mod case;
pub mod contract;
pub mod corpus;
pub mod family;
pub mod kernel;
pub mod oracle;
pub mod truth;
