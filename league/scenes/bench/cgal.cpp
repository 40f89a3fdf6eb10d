// CGAL's nearest hits: AABB_tree::first_intersection of a ray with triangles, for hairline rays and for times.
//     cgal epick|epeck answers MESH.obj RAYS.csv          a line a ray: face,t or -1
//     cgal epick|epeck time MESH.obj RAYS.csv COUNT       microseconds a ray, the least of three runs over COUNT rays
// The triangles have areas: CGAL asks for it.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

using std::string;
using std::vector;

struct Line {
    double o[3], d[3];
};

static vector<Line> read_rays(const char *path) {
    std::ifstream file(path);
    string text;
    std::getline(file, text);
    vector<Line> rays;
    while (std::getline(file, text)) {
        Line r;
        std::sscanf(text.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", r.o, r.o + 1, r.o + 2, r.d, r.d + 1, r.d + 2);
        rays.push_back(r);
    }
    return rays;
}

template <class K> struct Surface {
    typedef typename K::Point_3 Point;
    typedef typename K::Ray_3 Ray;
    typedef vector<typename K::Triangle_3> Triangles;
    typedef CGAL::AABB_triangle_primitive<K, typename Triangles::iterator> Primitive;
    typedef CGAL::AABB_tree<CGAL::AABB_traits<K, Primitive>> Tree;

    Triangles triangles;
    Tree tree;

    explicit Surface(const char *path) {
        std::ifstream file(path);
        vector<Point> points;
        string text;
        while (std::getline(file, text)) {
            double x, y, z;
            unsigned a, b, c;
            if (std::sscanf(text.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
                points.push_back(Point(x, y, z));
            else if (std::sscanf(text.c_str(), "f %u %u %u", &a, &b, &c) == 3)
                triangles.push_back(typename K::Triangle_3(points[a - 1], points[b - 1], points[c - 1]));
        }
        tree.insert(triangles.begin(), triangles.end());
        tree.build();
    }

    static Ray ray(const Line &r) {
        return Ray(Point(r.o[0], r.o[1], r.o[2]), typename K::Vector_3(r.d[0], r.d[1], r.d[2]));
    }

    // The nearest point of what a ray and a triangle share.
    static Point nearest(const Ray &ray, const Point *point, const typename K::Segment_3 *segment) {
        if (point) return *point;
        bool is_source = CGAL::has_smaller_distance_to_point(ray.source(), segment->source(), segment->target());
        return is_source ? segment->source() : segment->target();
    }

    void answer(const Line &r) const {
        auto hit = tree.first_intersection(ray(r));
        if (!hit) {
            std::puts("-1");
            return;
        }
        Point p = nearest(ray(r), boost::get<Point>(&hit->first), boost::get<typename K::Segment_3>(&hit->first));
        int axis = 0;
        for (int i = 1; i < 3; i++)
            if (std::fabs(r.d[i]) > std::fabs(r.d[axis])) axis = i;
        double t = CGAL::to_double((p[axis] - r.o[axis]) / r.d[axis]);
        std::printf("%ld,%.17g\n", (long)(hit->second - const_cast<Triangles &>(triangles).begin()), t);
    }

    double microseconds(const vector<Line> &rays, size_t count) const {
        double least = std::numeric_limits<double>::infinity();
        count = std::min(count, rays.size());
        size_t hits = 0;
        for (int times = 0; times < 3; times++) {
            timespec start, end;
            clock_gettime(CLOCK_MONOTONIC, &start);
            for (size_t i = 0; i < count; i++) hits += bool(tree.first_intersection(ray(rays[i])));
            clock_gettime(CLOCK_MONOTONIC, &end);
            double took = (end.tv_sec - start.tv_sec) + 1e-9 * (end.tv_nsec - start.tv_nsec);
            least = std::min(least, took * 1e6 / count);
        }
        return hits <= 3 * count ? least : 0;
    }
};

template <class K> static int run(int count, char **words) {
    Surface<K> surface(words[3]);
    vector<Line> rays = read_rays(words[4]);
    if (!std::strcmp(words[2], "time"))
        std::printf("%.3f\n", surface.microseconds(rays, count > 5 ? std::atol(words[5]) : rays.size()));
    else
        for (const Line &r : rays) surface.answer(r);
    return 0;
}

int main(int count, char **words) {
    if (count == 2 && !std::strcmp(words[1], "version")) return std::puts(CGAL_VERSION_STR) < 0;
    if (count < 5) return std::puts("cgal epick|epeck answers|time MESH.obj RAYS.csv [COUNT]"), 2;
    return !std::strcmp(words[1], "epeck") ? run<CGAL::Exact_predicates_exact_constructions_kernel>(count, words)
                                           : run<CGAL::Exact_predicates_inexact_constructions_kernel>(count, words);
}
