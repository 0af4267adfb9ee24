// What the programs around the libraries share: a mesh as lists of points and of faces, OFF files, the command line and
// the report.
#pragma once

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

using Point = std::array<double, 3>;

[[noreturn]] inline void fail(const std::string& message) {
  std::fprintf(stderr, "error: %s\n", message.c_str());
  std::exit(1);
}

// Points, and the corners of all faces, one face after the other, counter-clockwise.
struct Lists {
  std::vector<Point> points;
  std::vector<int> corners;
  std::vector<int> valences;  // of the faces
};

inline std::string read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// OFF without colours and comments.
inline Lists read_off(const std::string& path) {
  std::string text = read(path);
  const char *at = text.data(), *end = at + text.size();
  if (text.rfind("OFF", 0) != 0) fail(path + " is no OFF file");
  at += 3;
  auto number = [&](auto& x) {
    while (at < end && std::isspace(static_cast<unsigned char>(*at))) ++at;
    auto [next, error] = std::from_chars(at, end, x);
    if (error != std::errc()) fail(path + " is damaged");
    at = next;
  };
  int vertices, faces, edges;
  number(vertices), number(faces), number(edges);
  Lists lists;
  lists.points.resize(vertices);
  lists.valences.resize(faces);
  lists.corners.reserve(4 * static_cast<size_t>(faces));
  for (Point& p : lists.points) number(p[0]), number(p[1]), number(p[2]);
  for (int& valence : lists.valences) {
    number(valence);
    for (int i = 0; i < valence; ++i) {
      int corner;
      number(corner);
      if (corner < 0 || corner >= vertices) fail(path + " is damaged");
      lists.corners.push_back(corner);
    }
  }
  return lists;
}

// Each number with as many digits as tell the double exactly, at most 17.
inline void write_off(const Lists& lists, const std::string& path) {
  std::string text = "OFF\n" + std::to_string(lists.points.size()) + " " + std::to_string(lists.valences.size()) + " 0\n";
  auto number = [&](auto x, char after) {
    char digits[40];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr - digits);
    text += after;
  };
  for (const Point& p : lists.points) number(p[0], ' '), number(p[1], ' '), number(p[2], '\n');
  size_t at = 0;
  for (int valence : lists.valences) {
    number(valence, ' ');
    for (int i = 0; i < valence; ++i) number(lists.corners[at++], i + 1 < valence ? ' ' : '\n');
  }
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) fail("cannot write " + path);
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Two numbers that hardly two different surfaces share: the sum of the squares of all coordinates and the enclosed volume,
// of cones from the origin, whose heights are those of the faces' middles. As JSON without braces.
inline std::string sums(const Lists& lists) {
  double squares = 0, volume = 0;
  for (const Point& p : lists.points) squares += p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  const int* corner = lists.corners.data();
  for (int n : lists.valences) {
    Point sum{}, area{};
    for (int i = 0; i < n; ++i) {
      const Point &p = lists.points[corner[i]], &q = lists.points[corner[(i + 1) % n]], normal = cross(p, q);
      for (int axis = 0; axis < 3; ++axis) sum[axis] += p[axis], area[axis] += normal[axis];
    }
    for (int axis = 0; axis < 3; ++axis) volume += sum[axis] * area[axis] / (6 * n);
    corner += n;
  }
  char text[200];
  std::snprintf(text, sizeof text, "\"vertices\": %zu, \"volume\": %.17g, \"squares\": %.17g",
                lists.points.size(), volume, squares);
  return text;
}

// `program SCHEME IN.off [--name value]…`
struct Arguments {
  std::string scheme, input;
  std::map<std::string, std::string> options;

  Arguments(int count, char** values) {
    if (count < 3 || count % 2 == 0) fail("usage: " + std::string(values[0]) + " SCHEME IN.off [--steps N] [--output OUT.off] …");
    scheme = values[1], input = values[2];
    for (int i = 3; i < count; i += 2) options[values[i]] = values[i + 1];
  }
  std::string option(const std::string& name, const std::string& otherwise) const {
    auto found = options.find(name);
    return found == options.end() ? otherwise : found->second;
  }
  int steps() const { return std::stoi(option("--steps", "1")); }
};

// The time that `work` takes.
template <class Work> double seconds(Work work) {
  auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

// Writes the time and, if asked to, sums and the mesh: `lists` makes it.
template <class MakeLists> int report(const Arguments& arguments, double time, size_t faces, MakeLists make_lists) {
  std::printf("{\"seconds\": %.9f, \"faces\": %zu", time, faces);
  std::string output = arguments.option("--output", ""), check = arguments.option("--check", "no");
  if (!output.empty() || check == "yes") {
    Lists lists = make_lists();
    if (check == "yes") std::printf(", %s", sums(lists).c_str());
    if (!output.empty()) write_off(lists, output);
  }
  std::printf("}\n");
  return 0;
}
