//! CSV: a row a triangle. No field has a comma or a quote in it.

use super::number::nearest;
use super::test::{VectorTest, place, result, word};
use crate::files::number;

/// The first line, without its end.
pub const HEADER: &str = "id,triangle,triangles,scalar,group,parity,result,closed,open,free_because,\
    where,place,facing,t,u,v,margin,flags,ox,oy,oz,dx,dy,dz,t_min,t_max,ax,ay,az,bx,by,bz,cx,cy,cz";

/// The rows of a test, with their ends.
pub fn rows(test: &VectorTest) -> String {
    let mut text = String::new();
    let count = test.triangles.len().to_string();
    for (i, triangle) in test.triangles.iter().enumerate() {
        let crossing = triangle.truth.crossing();
        let mut row = vec![
            test.id.clone(),
            i.to_string(),
            count.clone(),
            test.scalar.to_string(),
        ];
        row.extend(
            test.group
                .map_or(["", ""], |g| [g.result(), g.parity()])
                .map(str::to_owned),
        );
        row.extend(
            [result(&triangle.truth), triangle.closed(), triangle.open()].map(|o| word(o).into()),
        );
        row.extend([
            triangle.free_because().join(" "),
            place(&triangle.truth).to_owned(),
        ]);
        row.push(
            crossing
                .map_or("", |crossing| crossing.place.name())
                .to_owned(),
        );
        row.push(
            crossing
                .map_or("", |crossing| crossing.facing.name())
                .to_owned(),
        );
        let value = |i: usize| triangle.values.as_ref().map(|values| nearest(&values[i]));
        let finite = |i: usize| value(i).filter(|value| value.is_finite());
        row.extend([0, 1, 2, 3].map(|i| finite(i).map_or(String::new(), number::write)));
        row.push(test.flags.join(" "));
        row.extend(
            test.ray
                .iter()
                .chain(&triangle.numbers)
                .map(|number| number.bits.clone()),
        );
        text.push_str(&row.join(","));
        text.push('\n');
    }
    text
}
