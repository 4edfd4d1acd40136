// Pairs triangles over shared edges: vertices are welded by position, edges matched by sorting, and a greedy
// matching serves the triangles with the fewest free neighbours first.
#include "renderer/accel/pairing.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace kilolux {

namespace {

using namespace shared;

// A pair is worth one box when that box has at most this much of the area of the two apart: every ray that
// enters it then tests a second triangle nearly for free.
constexpr float kMaxAreaGrowth = 1.6f;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

struct HalfEdge {
    std::uint64_t key; // smaller vertex id << 32 | larger
    std::uint32_t triangle;
    std::uint8_t edge; // from corner edge to corner edge + 1
    bool forward;      // from the smaller vertex id to the larger
};

std::uint64_t hashPosition(const glm::vec3& p) {
    std::uint32_t bits[3];
    std::memcpy(bits, &p, sizeof bits);
    std::uint64_t h = bits[0] * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 29) ^ bits[1]) * 0xBF58476D1CE4E5B9ull;
    h = (h ^ (h >> 32) ^ bits[2]) * 0x94D049BB133111EBull;
    return h ^ (h >> 31);
}

// One id per distinct position, by open addressing.
std::vector<std::uint32_t> weldVertices(const std::vector<SoupTriangle>& triangles) {
    std::size_t capacity = 16;
    while (capacity < triangles.size() * 4)
        capacity *= 2;
    std::vector<std::uint32_t> table(capacity, kNone);
    std::vector<std::uint32_t> ids(triangles.size() * 3);
    const auto positionOf = [&](std::uint32_t corner) { return triangles[corner / 3].position[corner % 3]; };
    for (std::uint32_t corner = 0; corner < ids.size(); ++corner) {
        // Adding zero makes -0 equal to +0 in bits as well.
        const glm::vec3 position = positionOf(corner) + glm::vec3(0.0f);
        std::size_t slot = hashPosition(position) & (capacity - 1);
        while (table[slot] != kNone && positionOf(table[slot]) != position)
            slot = (slot + 1) & (capacity - 1);
        if (table[slot] == kNone) table[slot] = corner;
        ids[corner] = table[slot];
    }
    return ids;
}

std::vector<HalfEdge> sortedHalfEdges(const std::vector<SoupTriangle>& triangles) {
    const std::vector<std::uint32_t> vertex = weldVertices(triangles);
    std::vector<HalfEdge> edges;
    edges.reserve(triangles.size() * 3);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t* v = &vertex[t * 3];
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue; // no area: stays alone
        for (std::uint32_t e = 0; e < 3; ++e) {
            const std::uint64_t from = v[e], to = v[(e + 1) % 3];
            edges.push_back({std::min(from, to) << 32 | std::max(from, to), t, std::uint8_t(e), from < to});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
    });
    return edges;
}

struct Neighbour {
    std::uint32_t triangle = kNone;
    std::uint8_t edge = 0;
};
using Neighbours = std::array<Neighbour, 3>;

float halfArea(const glm::vec3& size) {
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

glm::vec3 lowerOf(const SoupTriangle& t) {
    return glm::min(t.position[0], glm::min(t.position[1], t.position[2]));
}
glm::vec3 upperOf(const SoupTriangle& t) {
    return glm::max(t.position[0], glm::max(t.position[1], t.position[2]));
}

float unionHalfArea(const SoupTriangle& a, const SoupTriangle& b) {
    return halfArea(glm::max(upperOf(a), upperOf(b)) - glm::min(lowerOf(a), lowerOf(b)));
}

bool worthPairing(const SoupTriangle& a, const SoupTriangle& b) {
    const float apart = halfArea(upperOf(a) - lowerOf(a)) + halfArea(upperOf(b) - lowerOf(b));
    return a.alphaTested == b.alphaTested && unionHalfArea(a, b) <= kMaxAreaGrowth * apart;
}

std::vector<Neighbours> findNeighbours(const std::vector<SoupTriangle>& triangles) {
    std::vector<HalfEdge> edges = sortedHalfEdges(triangles);
    std::vector<Neighbours> neighbours(triangles.size());
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
        while (end < edges.size() && edges[end].key == edges[first].key)
            ++end;
        // More than two triangles may meet at an edge: each finds at most one partner of the other direction.
        for (std::size_t i = first; i < end; ++i) {
            for (std::size_t j = i + 1; j < std::min(end, i + 8); ++j) {
                Neighbour& mine = neighbours[edges[i].triangle][edges[i].edge];
                Neighbour& other = neighbours[edges[j].triangle][edges[j].edge];
                if (edges[i].forward == edges[j].forward || edges[i].triangle == edges[j].triangle ||
                    mine.triangle != kNone || other.triangle != kNone ||
                    !worthPairing(triangles[edges[i].triangle], triangles[edges[j].triangle]))
                    continue;
                mine = {edges[j].triangle, edges[j].edge};
                other = {edges[i].triangle, edges[i].edge};
            }
        }
    }
    return neighbours;
}

// The edge of each triangle over which it is paired, kNoEdge for those alone.
constexpr std::uint8_t kNoEdge = 255;

class Matching {
  public:
    Matching(const std::vector<SoupTriangle>& triangles, const std::vector<Neighbours>& neighbours)
        : pairedEdge(triangles.size(), kNoEdge), triangles_(triangles), neighbours_(neighbours),
          done_(triangles.size(), false) {
        for (std::uint32_t t = std::uint32_t(triangles.size()); t-- > 0;)
            queue_[freeNeighbours(t)].push_back(t);
        for (;;) {
            const auto bucket =
                std::find_if(queue_.begin() + 1, queue_.end(), [](const auto& q) { return !q.empty(); });
            if (bucket == queue_.end()) break;
            const std::uint32_t t = bucket->back();
            bucket->pop_back();
            if (!done_[t]) pairUp(t);
        }
    }

    std::vector<std::uint8_t> pairedEdge;

  private:
    std::size_t freeNeighbours(std::uint32_t t) const {
        std::size_t count = 0;
        for (const Neighbour& n : neighbours_[t])
            count += n.triangle != kNone && !done_[n.triangle];
        return count;
    }

    void pairUp(std::uint32_t t) {
        std::uint8_t best = kNoEdge;
        float bestArea = 0.0f;
        for (std::uint8_t e = 0; e < 3; ++e) {
            const std::uint32_t other = neighbours_[t][e].triangle;
            if (other == kNone || done_[other]) continue;
            const float area = unionHalfArea(triangles_[t], triangles_[other]);
            if (best == kNoEdge || area < bestArea) {
                best = e;
                bestArea = area;
            }
        }
        if (best == kNoEdge) return;
        const Neighbour partner = neighbours_[t][best];
        done_[t] = done_[partner.triangle] = true;
        pairedEdge[t] = best;
        pairedEdge[partner.triangle] = partner.edge;
        for (const std::uint32_t member : {t, partner.triangle})
            for (const Neighbour& n : neighbours_[member])
                if (n.triangle != kNone && !done_[n.triangle])
                    queue_[freeNeighbours(n.triangle)].push_back(n.triangle);
    }

    const std::vector<SoupTriangle>& triangles_;
    const std::vector<Neighbours>& neighbours_;
    std::vector<bool> done_;
    std::array<std::vector<std::uint32_t>, 4> queue_; // by number of free neighbours when queued
};

std::uint32_t packId(const SoupTriangle& triangle, std::uint32_t rotation) {
    const std::uint32_t turn = rotation + (triangle.swapped ? 3u : 0u);
    return triangle.id << BVH_ID_TURN_BITS | turn | (triangle.alphaTested ? BVH_ID_ALPHA : 0u);
}

} // namespace

TrianglePairs pairTriangles(const std::vector<SoupTriangle>& triangles) {
    const std::vector<Neighbours> neighbours = findNeighbours(triangles);
    const Matching matching(triangles, neighbours);
    TrianglePairs result;
    result.pairs.reserve(triangles.size() * 5 / 8);
    result.ids.reserve(triangles.size() * 5 / 8);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const glm::vec3* p = triangles[t].position;
        const std::uint8_t edge = matching.pairedEdge[t];
        if (edge == kNoEdge) {
            result.pairs.push_back({p[0], p[1], p[2], p[2]});
            result.ids.push_back({packId(triangles[t], 0), BVH_ID_NONE});
            continue;
        }
        const Neighbour& partner = neighbours[t][edge];
        if (partner.triangle < t) continue; // written with its partner
        // Turned so that the shared edge is b -> c here and c -> b there.
        const std::uint32_t rotation = (edge + 2u) % 3u;
        const glm::vec3* q = triangles[partner.triangle].position;
        result.pairs.push_back({p[rotation], p[edge], p[(edge + 1u) % 3u], q[(partner.edge + 2u) % 3u]});
        result.ids.push_back(
            {packId(triangles[t], rotation), packId(triangles[partner.triangle], partner.edge)});
    }
    return result;
}

} // namespace kilolux
