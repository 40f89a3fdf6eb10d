//! Which faces meet at each point of a mesh.

/// The faces at each point of a mesh, collapsed ones left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Incidence {
    /// Where each point's faces start, and the last one's end.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl Incidence {
    /// The incidence of faces by their points; faces that take no part are left out.
    pub(super) fn of(
        points: usize,
        corners: &[[u32; 3]],
        takes_part: impl Fn(usize) -> bool,
    ) -> Incidence {
        let parts = || (0..).zip(corners).filter(|(face, _)| takes_part(*face as usize));
        let mut starts = vec![0u32; points + 1];
        parts().flat_map(|(_, corners)| corners).for_each(|point| starts[*point as usize + 1] += 1);
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut faces = vec![0u32; starts[points] as usize];
        let mut next = starts.clone();
        for (face, corners) in parts() {
            for point in corners {
                let place = &mut next[*point as usize];
                faces[*place as usize] = face;
                *place += 1;
            }
        }
        Incidence { starts, faces }
    }

    /// The faces at a point. Panics if there is no such point.
    pub fn at(&self, point: usize) -> &[u32] {
        &self.faces[self.starts[point] as usize..self.starts[point + 1] as usize]
    }
}
