// OpenMesh's uniform subdividers: `openmesh SCHEME IN.off …`, SCHEME loop, sqrt3, butterfly (modified) or catmull-clark.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>

#include "mesh.hpp"

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;  // Loop's scheme computes positions in this type
};
using Triangles = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

template <class Mesh> static Mesh load(const std::string& path) {
  Lists lists = read_off(path);
  Mesh mesh;
  mesh.reserve(lists.points.size(), lists.corners.size() / 2, lists.valences.size());
  for (const Point& p : lists.points) mesh.add_vertex({p[0], p[1], p[2]});
  size_t at = 0;
  std::vector<OpenMesh::VertexHandle> face;
  for (int valence : lists.valences) {
    face.clear();
    for (int i = 0; i < valence; ++i) face.emplace_back(lists.corners[at++]);
    if (!mesh.add_face(face).is_valid()) fail("OpenMesh does not accept " + path);
  }
  return mesh;
}

template <template <class, class> class Subdivider, class Mesh> static int run(const Arguments& arguments) {
  Mesh mesh = load<Mesh>(arguments.input);
  Subdivider<Mesh, double> subdivide;
  int steps = arguments.steps();
  double time = seconds([&] {
    if (!subdivide(mesh, steps)) fail("OpenMesh fails on " + arguments.input);
  });
  return report(arguments, time, mesh.n_faces(), [&] {
    Lists lists;
    for (auto v : mesh.vertices()) lists.points.push_back({mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]});
    for (auto f : mesh.faces()) {
      int valence = 0;
      for (auto v : mesh.fv_range(f)) lists.corners.push_back(v.idx()), ++valence;
      lists.valences.push_back(valence);
    }
    return lists;
  });
}

int main(int count, char** values) {
  using namespace OpenMesh::Subdivider::Uniform;
  Arguments arguments(count, values);
  if (arguments.scheme == "loop") return run<LoopT, Triangles>(arguments);
  if (arguments.scheme == "sqrt3") return run<Sqrt3T, Triangles>(arguments);
  if (arguments.scheme == "butterfly") return run<ModifiedButterflyT, Triangles>(arguments);
  if (arguments.scheme == "catmull-clark") return run<CatmullClarkT, Polygons>(arguments);
  fail("OpenMesh has no " + arguments.scheme);
}
