// tinybvh's nearest hits (its header tiny_bvh.h) for `hairline rays`:
//     c++ -O2 -I path/to/tinybvh -o tinybvh_answers tinybvh_answers.cpp
//     ./tinybvh_answers model.obj rays.csv > answers.csv
#define TINYBVH_IMPLEMENTATION
#include "tiny_bvh.h"
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

int main(int, char **files) {
    std::vector<tinybvh::bvhvec4> vertices, corners; // three corners a face, in the order of the file
    std::ifstream mesh(files[1]), rays(files[2]);
    std::string line;
    while (std::getline(mesh, line)) {
        float x, y, z;
        unsigned face[3];
        if (std::sscanf(line.c_str(), "v %f %f %f", &x, &y, &z) == 3) vertices.push_back({x, y, z, 0});
        if (std::sscanf(line.c_str(), "f %u %u %u", face, face + 1, face + 2) == 3)
            for (unsigned vertex : face) corners.push_back(vertices[vertex - 1]);
    }
    tinybvh::BVH tree;
    tree.Build(corners.data(), (uint32_t)(corners.size() / 3));
    std::getline(rays, line);
    while (std::getline(rays, line)) {
        float o[3], d[3];
        std::sscanf(line.c_str(), "%f,%f,%f,%f,%f,%f", o, o + 1, o + 2, d, d + 1, d + 2);
        tinybvh::Ray ray({o[0], o[1], o[2]}, {d[0], d[1], d[2]}); // which makes the direction a unit vector
        tree.Intersect(ray);
        double length = std::sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
        if (ray.hit.t == BVH_FAR)
            std::puts("-1");
        else
            std::printf("%u,%.17g\n", ray.hit.prim, ray.hit.t / length);
    }
}
