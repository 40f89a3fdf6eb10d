//! A closed mesh in some size, with its exact scene and points inside.

use crate::structure::{Part, Triangle};
use hairline_core::case::Draw;
use hairline_files::mesh::Mesh;
use hairline_scene::{Location, Scene};
use std::collections::BTreeMap;

/// How many balls inside rays start in.
const BALLS: usize = 1024;

/// How many points are tried to find them.
const TRIES: u64 = 200_000;

/// A ball has this share of its middle's distance from the surface as its radius, so that it is inside whatever is rounded.
const SHARE: f64 = 0.5;

/// A ball of fewer ulps than this is a point.
const FEWEST_ULPS: f64 = 64.0;

/// Vertices on a grid are multiples of about this share of the mesh's size: 2^-18, so that differences of two are exact in f32.
const GRID: f64 = 1.0 / 262_144.0;

/// A closed mesh.
pub struct World {
    pub triangles: Vec<Triangle>,
    /// Its exact scene.
    pub scene: Scene<f32>,
    /// Balls inside: x, y, z of a point that is exactly inside, and the radius.
    pub balls: Vec<[f32; 4]>,
    seed: u32,
    vertices: Vec<[f32; 3]>,
    faces: Vec<[u32; 3]>,
    low: [f64; 3],
    high: [f64; 3],
}

impl World {
    /// A mesh, scaled. An error if it is not closed, or if no points inside are found. The seed chooses these.
    pub fn new(mesh: &Mesh, scale: f64, seed: u32) -> Result<World, String> {
        let scaled = |vertex: &[f64; 3]| vertex.map(|x| (x * scale) as f32);
        let vertices = match scale == 1.0 {
            true => mesh.positions_f32.clone(),
            false => mesh.positions_f64.iter().map(scaled).collect(),
        };
        World::of(vertices, mesh.triangles.clone(), seed)
    }

    fn of(vertices: Vec<[f32; 3]>, faces: Vec<[u32; 3]>, seed: u32) -> Result<World, String> {
        let scene = Scene::new(&vertices, &faces).map_err(|error| error.to_string())?;
        if !scene.not_finite().is_empty() {
            return Err("a coordinate is beyond the range of f32".to_owned());
        }
        let corner = |vertex: u32| vertices[vertex as usize];
        let triangles: Vec<Triangle> = faces.iter().map(|face| face.map(corner)).collect();
        let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for vertex in triangles.iter().flatten() {
            for axis in 0..3 {
                low[axis] = low[axis].min(f64::from(vertex[axis]));
                high[axis] = high[axis].max(f64::from(vertex[axis]));
            }
        }
        let mut world = World {
            triangles,
            scene,
            balls: Vec::new(),
            seed,
            vertices,
            faces,
            low,
            high,
        };
        world.find_balls()?;
        Ok(world)
    }

    /// Finds points in the box of the mesh that are inside, and how far the surface is from them.
    fn find_balls(&mut self) -> Result<(), String> {
        for index in 0..TRIES {
            let draw = &mut Draw::new("points-inside", self.seed.into(), index);
            let point = [0, 1, 2].map(|axis| {
                let share: f64 = draw.unit();
                (self.low[axis] + share * (self.high[axis] - self.low[axis])) as f32
            });
            match self.scene.locate(point) {
                Ok(Location::Off(winding)) if !winding.is_zero() => {
                    let [x, y, z] = point;
                    self.balls.push([x, y, z, self.radius(point)]);
                }
                Ok(Location::NotDefined(_)) => {
                    return Err("the surface is open, so rays may leave it".to_owned());
                }
                _ => {}
            }
            if self.balls.len() == BALLS {
                break;
            }
        }
        match self.balls.is_empty() {
            true => Err(format!("none of {TRIES} points in its box is inside")),
            false => Ok(()),
        }
    }

    /// The balls that a ray does not miss which starts so far away and passes their middle but for rounding. A ray's origin and
    /// direction are rounded, to 2^-24 of the distance in each coordinate.
    pub fn balls_seen_from(&self, distance: f32) -> Vec<[f32; 4]> {
        let least = distance / 2f32.powi(22);
        let mut seen = self.balls.clone();
        seen.retain(|[_, _, _, radius]| least <= *radius);
        seen
    }

    /// True if rays from so far away have room to end inside, and their numbers are in the middle of the range of f32.
    pub fn is_seen_from(&self, distance: f32) -> bool {
        let is_in_range = (1e-30..1e30).contains(&self.size()) && distance < 1e30;
        is_in_range && !self.balls_seen_from(distance).is_empty()
    }

    /// The length of the box's diagonal.
    pub fn size(&self) -> f32 {
        let sides = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        sides.iter().map(|side| side * side).sum::<f64>().sqrt() as f32
    }

    fn radius(&self, middle: [f32; 3]) -> f32 {
        let largest = middle.iter().fold(0.0, |most: f32, x| most.max(x.abs()));
        let ulp = f64::from(largest.next_up() - largest);
        match self.scene.distance(middle).map(|distance| SHARE * distance) {
            Some(radius) if FEWEST_ULPS * ulp < radius => radius as f32,
            _ => 0.0,
        }
    }

    /// The mesh with its vertices on a grid, which moves them by at most 2^-18 of the largest coordinate. An error if it is not closed
    /// then, or without an inside.
    pub fn on_a_grid(&self) -> Result<World, String> {
        let step = self.step();
        let on_grid =
            |vertex: &[f32; 3]| vertex.map(|x| ((f64::from(x) / step).round() * step) as f32);
        let vertices = self.vertices.iter().map(on_grid).collect();
        World::of(vertices, self.faces.clone(), self.seed)
    }

    /// The grid's step, a power of two.
    fn step(&self) -> f64 {
        let ends = self.low.iter().chain(&self.high);
        let size = ends.fold(0.0, |most: f64, x| most.max(x.abs()));
        (size * GRID).log2().ceil().exp2()
    }

    /// The faces by the tile of their middle, each tile moved to its place by a translation: in exact arithmetic every vertex
    /// comes back to where it was. The vertices have to be on the grid.
    pub fn tiles(&self, a_side: u32) -> Vec<Part> {
        let mut tiles: BTreeMap<[u32; 3], Vec<Triangle>> = BTreeMap::new();
        for triangle in &self.triangles {
            tiles
                .entry(self.tile_of(triangle, a_side))
                .or_default()
                .push(*triangle);
        }
        let part = |(tile, triangles): ([u32; 3], Vec<Triangle>)| {
            let translation = self.middle_of(tile, a_side);
            let moved = |vertex: [f32; 3]| [0, 1, 2].map(|axis| vertex[axis] - translation[axis]);
            let triangles = triangles.into_iter().map(|triangle| triangle.map(moved));
            Part {
                triangles: triangles.collect(),
                translation,
            }
        };
        tiles.into_iter().map(part).collect()
    }

    fn tile_of(&self, triangle: &Triangle, a_side: u32) -> [u32; 3] {
        [0, 1, 2].map(|axis| {
            let sum: f64 = triangle.iter().map(|vertex| f64::from(vertex[axis])).sum();
            let share = (sum / 3.0 - self.low[axis]) / (self.high[axis] - self.low[axis]);
            // A flat box gives NaN, which becomes 0.
            let place = (share * f64::from(a_side)) as u32;
            place.min(a_side - 1)
        })
    }

    /// The point of the grid that is nearest to the middle of a tile.
    fn middle_of(&self, tile: [u32; 3], a_side: u32) -> [f32; 3] {
        let step = self.step();
        [0, 1, 2].map(|axis| {
            let share = (f64::from(tile[axis]) + 0.5) / f64::from(a_side);
            let middle = self.low[axis] + share * (self.high[axis] - self.low[axis]);
            ((middle / step).round() * step) as f32
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn icosphere() -> Mesh {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../corpora/meshes/icosphere.obj"
        );
        crate::input::read_mesh(path).unwrap_or_else(|failure| panic!("{}", failure.message))
    }

    #[test]
    fn tiles_come_back_to_where_they_were() {
        let world = World::new(&icosphere(), 1.0, 1)
            .unwrap()
            .on_a_grid()
            .unwrap();
        let sorted = |mut triangles: Vec<Triangle>| {
            triangles.sort_by_key(|triangle| triangle.map(|vertex| vertex.map(f32::to_bits)));
            triangles
        };
        let tiles = world.tiles(3);
        assert!(20 < tiles.len());
        let mut moved_back = Vec::new();
        for tile in &tiles {
            for triangle in &tile.triangles {
                moved_back.push(triangle.map(|vertex| {
                    [0, 1, 2].map(|axis| {
                        // The sum of two floats, exactly.
                        let exact = f64::from(vertex[axis]) + f64::from(tile.translation[axis]);
                        assert_eq!(f64::from(exact as f32), exact);
                        exact as f32
                    })
                }));
            }
        }
        assert_eq!(sorted(moved_back), sorted(world.triangles.clone()));
    }

    #[test]
    fn balls_are_inside() {
        let world = World::new(&icosphere(), 1.0, 2).unwrap();
        assert_eq!(world.balls.len(), BALLS);
        let mut with_a_size = 0;
        for &[x, y, z, radius] in &world.balls {
            with_a_size += usize::from(0.0 < radius);
            for axis in 0..3 {
                for side in [-radius, radius] {
                    let mut point = [x, y, z];
                    point[axis] += side;
                    let place = world.scene.locate(point).unwrap();
                    assert_eq!(place.is_inside_or_on(), Some(true));
                }
            }
        }
        assert!(BALLS / 2 < with_a_size);
        let others = World::new(&icosphere(), 1.0, 3).unwrap();
        assert_ne!(world.balls, others.balls);
    }

    #[test]
    fn balls_that_are_seen_from_afar_are_larger_than_what_is_rounded() {
        let world = World::new(&icosphere(), 1.0, 2).unwrap();
        assert_eq!(world.balls_seen_from(0.0), world.balls);
        let afar = 1e5 * world.size();
        let seen = world.balls_seen_from(afar);
        assert!(BALLS / 2 < seen.len() && seen.len() < BALLS);
        // Two ulps of a coordinate of the origin.
        let rounded = 2.0 * (afar.next_up() - afar);
        assert!(seen.iter().all(|[_, _, _, radius]| rounded < *radius));
        assert!(world.is_seen_from(afar) && !world.is_seen_from(1e9 * world.size()));
        for scale in [1e-35, 1e32] {
            let world = World::new(&icosphere(), scale, 2).unwrap();
            assert!(!world.is_seen_from(10.0 * world.size()), "{scale}");
        }
    }

    #[test]
    fn an_open_mesh_is_refused() {
        let mut mesh = icosphere();
        mesh.triangles.pop();
        let refused = World::new(&mesh, 1.0, 1).err();
        assert_eq!(
            refused.as_deref(),
            Some("the surface is open, so rays may leave it")
        );
    }
}
