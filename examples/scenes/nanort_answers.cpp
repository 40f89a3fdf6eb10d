// NanoRT's nearest hits (its header nanort.h) for `hairline rays`:
//     c++ -O2 -I path/to/nanort -o nanort_answers nanort_answers.cpp
//     ./nanort_answers model.obj rays.csv > answers.csv
#include "nanort.h"
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

int main(int, char **files) {
    std::vector<float> vertices;
    std::vector<unsigned> faces;
    std::ifstream mesh(files[1]), rays(files[2]);
    std::string line;
    while (std::getline(mesh, line)) {
        float x, y, z;
        unsigned a, b, c;
        if (std::sscanf(line.c_str(), "v %f %f %f", &x, &y, &z) == 3) vertices.insert(vertices.end(), {x, y, z});
        if (std::sscanf(line.c_str(), "f %u %u %u", &a, &b, &c) == 3) faces.insert(faces.end(), {a - 1, b - 1, c - 1});
    }
    const size_t stride = 3 * sizeof(float);
    nanort::TriangleMesh<float> triangles(vertices.data(), faces.data(), stride);
    nanort::TriangleSAHPred<float> cost(vertices.data(), faces.data(), stride);
    nanort::BVHAccel<float> tree;
    tree.Build((unsigned)(faces.size() / 3), triangles, cost);
    std::getline(rays, line);
    while (std::getline(rays, line)) {
        nanort::Ray<float> ray;
        std::sscanf(line.c_str(), "%f,%f,%f,%f,%f,%f", ray.org, ray.org + 1, ray.org + 2, ray.dir, ray.dir + 1, ray.dir + 2);
        ray.min_t = 0;
        ray.max_t = std::numeric_limits<float>::max();
        nanort::TriangleIntersector<> intersector(vertices.data(), faces.data(), stride);
        nanort::TriangleIntersection<> hit;
        if (tree.Traverse(ray, intersector, &hit))
            std::printf("%u,%.9g\n", hit.prim_id, hit.t);
        else
            std::puts("-1");
    }
}
