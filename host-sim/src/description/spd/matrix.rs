//! 4x4 matrices for row vectors, `v * M`, as the Standard Procedural Databases use them.
//!
//! Order of the sums is part of the definition: the last digits of near-zero numbers show it.

use crate::description::Triple;

/// Rows of a matrix; the last row translates.
pub(super) type Matrix = [[f64; 4]; 4];

/// Changes nothing.
pub(super) const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// The same factor on all axes.
pub(super) fn scaling(factor: f64) -> Matrix {
    let mut m = IDENTITY;
    for (i, row) in m.iter_mut().enumerate().take(3) {
        row[i] = factor;
    }
    m
}

/// A shift by `by`.
pub(super) fn translation(by: Triple) -> Matrix {
    let mut m = IDENTITY;
    m[3][..3].copy_from_slice(&by);
    m
}

/// Rotation in the plane of two axes: from axis `from` towards axis `to`.
fn plane_rotation(from: usize, to: usize, angle: f64) -> Matrix {
    let (sine, cosine) = angle.sin_cos();
    let mut m = IDENTITY;
    m[from][from] = cosine;
    m[to][to] = cosine;
    m[from][to] = sine;
    m[to][from] = -sine;
    m
}

/// Rotation about x, y to z.
pub(super) fn rotation_x(angle: f64) -> Matrix {
    plane_rotation(1, 2, angle)
}

/// Rotation about y, z to x.
pub(super) fn rotation_y(angle: f64) -> Matrix {
    plane_rotation(2, 0, angle)
}

/// Rotation about z, x to y.
pub(super) fn rotation_z(angle: f64) -> Matrix {
    plane_rotation(0, 1, angle)
}

/// Rotation about the unit vector `axis`.
pub(super) fn rotation_about(axis: Triple, angle: f64) -> Matrix {
    let (sine, cosine) = angle.sin_cos();
    let rest = 1.0 - cosine;
    let mut m = IDENTITY;
    for i in 0..3 {
        let square = axis[i] * axis[i];
        m[i][i] = square + (1.0 - square) * cosine;
    }
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (0, 2, 1)] {
        let both = axis[i] * axis[j] * rest;
        let turn = axis[k] * sine;
        // (0, 2, 1) is an odd permutation.
        let turn = if i == 0 && j == 2 { -turn } else { turn };
        m[i][j] = both + turn;
        m[j][i] = both - turn;
    }
    m
}

/// First `a`, then `b`.
pub(super) fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| coord(&a[i], b))
}

/// `v * m` for four coordinates.
pub(super) fn coord(v: &[f64; 4], m: &Matrix) -> [f64; 4] {
    std::array::from_fn(|j| v[0] * m[0][j] + v[1] * m[1][j] + v[2] * m[2][j] + v[3] * m[3][j])
}

/// `p` rotated and translated.
pub(super) fn point(p: Triple, m: &Matrix) -> Triple {
    std::array::from_fn(|j| p[0] * m[0][j] + p[1] * m[1][j] + p[2] * m[2][j] + m[3][j])
}

/// `v` rotated only.
pub(super) fn vector(v: Triple, m: &Matrix) -> Triple {
    std::array::from_fn(|j| v[0] * m[0][j] + v[1] * m[1][j] + v[2] * m[2][j])
}

/// Sum.
pub(super) fn add(a: Triple, b: Triple) -> Triple {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Cross product.
pub(super) fn cross(a: Triple, b: Triple) -> Triple {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `v` at length 1, or unchanged where it has none.
pub(super) fn normalized(v: Triple) -> Triple {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 0.0 { v.map(|x| x / length) } else { v }
}
