// CGAL's Subdivision_method_3: `cgal SCHEME IN.off …`, SCHEME loop, catmull-clark, doo-sabin or sqrt3.
// With -DPOLYHEDRON the mesh is a Polyhedron_3 (the tutorial's), without a Surface_mesh (faster). Steps of one call, so
// that CGAL's √3 knows the parity of each.
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include "mesh.hpp"

using Kernel = CGAL::Simple_cartesian<double>;
#ifdef POLYHEDRON
using Mesh = CGAL::Polyhedron_3<Kernel>;
#else
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
#endif

static Mesh load(const std::string& path) {
  Lists lists = read_off(path);
  std::vector<Kernel::Point_3> points;
  for (const Point& p : lists.points) points.emplace_back(p[0], p[1], p[2]);
  std::vector<std::vector<std::size_t>> faces;
  auto corner = lists.corners.begin();
  for (int valence : lists.valences) faces.emplace_back(corner, corner + valence), corner += valence;
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

static Lists lists_of(const Mesh& mesh) {
  Lists lists;
  std::map<boost::graph_traits<Mesh>::vertex_descriptor, int> number;
  auto point = get(CGAL::vertex_point, mesh);
  for (auto v : vertices(mesh)) {
    number.emplace(v, static_cast<int>(lists.points.size()));
    auto p = get(point, v);
    lists.points.push_back({p.x(), p.y(), p.z()});
  }
  for (auto f : faces(mesh)) {
    int valence = 0;
    for (auto v : vertices_around_face(halfedge(f, mesh), mesh)) lists.corners.push_back(number.at(v)), ++valence;
    lists.valences.push_back(valence);
  }
  return lists;
}

int main(int count, char** values) {
  Arguments arguments(count, values);
  Mesh mesh = load(arguments.input);
  auto steps = CGAL::parameters::number_of_iterations(arguments.steps());
  namespace Method = CGAL::Subdivision_method_3;
  double time = seconds([&] {
    if (arguments.scheme == "loop") Method::Loop_subdivision(mesh, steps);
    else if (arguments.scheme == "catmull-clark") Method::CatmullClark_subdivision(mesh, steps);
    else if (arguments.scheme == "doo-sabin") Method::DooSabin_subdivision(mesh, steps);
    else if (arguments.scheme == "sqrt3") Method::Sqrt3_subdivision(mesh, steps);
    else fail("CGAL has no " + arguments.scheme);
  });
  auto all = faces(mesh);  // num_faces counts removed ones, too
  return report(arguments, time, std::distance(all.begin(), all.end()), [&] { return lists_of(mesh); });
}
