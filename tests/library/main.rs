//! The library through its public items, against definitions, laws and published facts. One binary,
//! because each one links the whole library.

mod accuracy;
mod arithmetic;
mod attribution;
mod contradictions;
mod derived;
mod drawing;
mod drawn;
mod exact;
mod expectations;
mod facts;
mod families;
mod floors;
mod map;
mod margins;
mod offset;
mod oracle;
mod planes;
mod proofs;
mod prove;
mod response;
mod rounded;
mod scene_sentences;
mod scenes;
mod sentences;
mod severity;
mod shrink;
mod strategy;
mod surroundings;
mod trials;
mod vectors;
mod watertight;
mod world;
