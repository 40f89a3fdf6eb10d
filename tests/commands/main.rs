//! The program `hairline`, command by command, as its users run it. One binary, because each one links
//! the whole library.

#[cfg(unix)]
mod action;
mod attribution;
mod boxes;
mod boxes_check;
mod boxes_own;
mod boxes_prove;
mod boxes_published;
mod case_forms;
mod check;
mod claims;
mod cli;
mod devices;
mod diff;
mod epsilon;
#[cfg(unix)]
mod exact;
mod formats;
mod found;
mod fuzz;
mod generate;
mod help;
#[cfg(unix)]
mod hostile;
mod html;
mod instances;
mod io;
mod json_schema;
mod map_command;
mod mesh;
mod mesh_files;
mod mesh_page;
mod numbers;
mod offset;
mod own;
mod permitted;
mod plugin;
mod program;
mod prove;
mod prove_domain;
mod rays;
mod rays_given;
mod rays_instances;
mod rays_judged;
mod rays_pictures;
mod rays_program;
#[cfg(unix)]
mod relations;
#[cfg(unix)]
mod repair;
mod repair_languages;
#[cfg(unix)]
mod repair_products;
mod repair_smaller;
mod rows;
mod scene;
mod scene_advice;
mod screen;
mod secondary;
mod shards;
mod shrink;
#[cfg(unix)]
mod terminal;
mod tools;
mod trust;
mod variants;
mod vectors;
mod worst;
mod wrong_kernels;
