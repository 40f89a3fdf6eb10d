//! stub
pub mod arith;
pub mod audit;
pub mod case;
pub mod contract;
pub mod corpus;
pub mod family;
pub mod judge;
pub mod kernel;
pub mod oracle;
pub mod truth;
