// Which of many bodies may touch, and which are near: as if all pairs were looked at, without.
#include "sim/model/contact_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "sim/build/build_model.hpp"
#include "sim/model/near_contacts.hpp"
#include "sim/step/stepper.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_pairs_test {

using Member = ContactPairs::Member;
using Named = ContactPairs::Named;

/// The friction of a made pair tells its entry: named ones from 1 on, sets from 100 on.
ContactPairs::Makers telling_makers() {
  ContactPairs::Makers makers;
  makers.of_named = [](const Named& named) {
    ContactModel made;
    made.a = named.a;
    made.b = named.b;
    made.law.friction = 1 + static_cast<double>(named.entry);
    return made;
  };
  makers.of_members = [](int a, int b, std::size_t bit) {
    ContactModel made;
    made.a = a;
    made.b = b;
    made.law.friction = 100 + static_cast<double>(bit);
    return made;
  };
  return makers;
}

/// Entries in plain words, and what they say of each pair one by one.
struct Rules {
  std::vector<Named> named;
  std::vector<Member> members;

  /// By pair, the lower body first: the friction that telling_makers() gives it.
  std::map<std::pair<int, int>, double> one_by_one() const {
    std::map<std::pair<int, int>, double> pairs;
    const auto n = static_cast<int>(members.size());
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) {
        const Member &p = members[static_cast<std::size_t>(a)],
                     &q = members[static_cast<std::size_t>(b)];
        if (p.is_fixed && q.is_fixed) continue;
        for (int bit = 63; bit >= 0; --bit) {  // the lowest holds
          const auto has = [&](std::uint64_t set) { return (set >> bit & 1) != 0; };
          if ((has(p.first) && has(q.second)) || (has(q.first) && has(p.second)))
            pairs[{a, b}] = 100 + bit;
        }
      }
    for (const Named& pair : named)
      pairs[std::minmax(pair.a, pair.b)] = 1 + static_cast<double>(pair.entry);
    return pairs;
  }
};

Rules random_rules(std::mt19937& random) {
  Rules rules;
  const int n = 2 + static_cast<int>(random() % 9);
  for (int body = 0; body < n; ++body) {
    Member member;
    if (random() % 4 != 0) {
      member.first = random() % 8;
      member.second = random() % 8;
    }
    member.is_fixed = random() % 3 == 0;
    rules.members.push_back(member);
  }
  std::set<std::pair<int, int>> used;
  for (std::size_t k = random() % 4; k > 0; --k) {
    const Named pair{static_cast<int>(random() % static_cast<unsigned>(n)),
                     static_cast<int>(random() % static_cast<unsigned>(n)), rules.named.size()};
    if (used.insert(std::minmax(pair.a, pair.b)).second) rules.named.push_back(pair);
  }
  return rules;
}

void expect_pairs(const ContactPairs& pairs, int num_bodies,
                  const std::map<std::pair<int, int>, double>& expected) {
  EXPECT_EQ(pairs.size(), std::ssize(expected));
  EXPECT_EQ(pairs.empty(), expected.empty());
  std::map<std::pair<int, int>, double> found;
  std::vector<char> touches(static_cast<std::size_t>(num_bodies), 0);
  ContactId last = -1;
  for (const ContactId contact : pairs.all()) {
    EXPECT_GT(contact, last);
    last = contact;
    const ContactModel made = pairs[contact];
    found[std::minmax(made.a, made.b)] = made.law.friction;
    EXPECT_EQ(pairs.between(made.a, made.b), contact);
    EXPECT_EQ(pairs.between(made.b, made.a), contact);
    for (const int body : {made.a, made.b}) touches[static_cast<std::size_t>(body)] = 1;
  }
  EXPECT_EQ(found, expected);
  for (int a = 0; a < num_bodies; ++a) {
    EXPECT_EQ(pairs.touches(a), touches[static_cast<std::size_t>(a)] != 0);
    for (int b = a; b < num_bodies; ++b)
      EXPECT_EQ(pairs.between(a, b).has_value(), expected.contains({a, b}));
  }
}

TEST(ContactPairs, AreThoseOfLookingAtAllPairsOneByOne) {
  std::mt19937 random(1);
  std::size_t num_pairs = 0, num_without = 0;
  for (int k = 0; k < 400; ++k) {
    const Rules rules = random_rules(random);
    const auto expected = rules.one_by_one();
    const ContactPairs pairs(rules.named, rules.members, telling_makers());
    expect_pairs(pairs, static_cast<int>(rules.members.size()), expected);
    num_pairs += expected.size();
    num_without += expected.empty() ? 1 : 0;
    // What any pair does one of each kind does.
    for (const auto& [bodies, friction] : expected)
      EXPECT_TRUE(friction < 100 || pairs.any([&, f = friction](const ContactModel& kind) {
        return kind.law.friction == f;
      })) << friction;
  }
  EXPECT_GT(num_pairs, 2000U);
  EXPECT_GT(num_without, 10U);
}

TEST(ContactPairs, OneAloneOrAllButOneAreThat) {
  std::mt19937 random(2);
  for (int k = 0; k < 100; ++k) {
    const Rules rules = random_rules(random);
    const auto expected = rules.one_by_one();
    const ContactPairs pairs(rules.named, rules.members, telling_makers());
    const auto n = static_cast<int>(rules.members.size());
    for (const auto& [bodies, friction] : expected) {
      const ContactId contact = pairs.between(bodies.first, bodies.second).value();
      const ContactPairs alone = pairs.only(contact), rest = pairs.without(contact);
      expect_pairs(alone, n, {{bodies, friction}});
      EXPECT_EQ(rest.size(), pairs.size() - 1);
      EXPECT_FALSE(rest.between(bodies.first, bodies.second));
      EXPECT_EQ(rest.all().size() + 1, expected.size());
    }
  }
}

TEST(ContactPairs, WithoutAnyNothingTouches) {
  const ContactPairs none;
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.touches(3));
  EXPECT_FALSE(none.between(0, 1));
  EXPECT_TRUE(none.all().empty());
  EXPECT_FALSE(none.any([](const ContactModel&) { return true; }));
}

TEST(ContactPairs, NamedOnesComeFirstInTheirOrderThenTheOthersByTheirBodies) {
  std::vector<Member> members(5);
  for (Member& member : members) member.first = member.second = 1;
  const ContactPairs pairs({{3, 1, 0}, {0, 4, 1}}, members, telling_makers());
  std::vector<std::pair<int, int>> order;
  for (const ContactId contact : pairs.all())
    order.emplace_back(pairs[contact].a, pairs[contact].b);
  const std::vector<std::pair<int, int>> expected = {{3, 1}, {0, 4}, {0, 1}, {0, 2}, {0, 3},
                                                     {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
  EXPECT_EQ(order, expected);
}

TEST(ContactPairs, OfManyBodiesTakeNoTimeAndMemoryOfTheirOwn) {
  std::vector<Member> members(100000);
  for (Member& member : members) member.first = member.second = 1;
  const ContactPairs pairs({}, members, telling_makers());
  EXPECT_EQ(pairs.size(), 100000LL * 99999 / 2);
  EXPECT_EQ(pairs.kinds().size(), 1U);
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 99999), std::pair(70000, 70001),
                             std::pair(99998, 99999), std::pair(31415, 92653)}) {
    const ContactModel made = pairs[pairs.between(b, a).value()];
    EXPECT_EQ(std::pair(made.a, made.b), std::pair(a, b));
  }
}

/// n³ rigid cubes, a little out of line, over a fixed floor; the gaps between them are a part of
/// the cubes' side.
Scenario heap(int n, double gap) {
  constexpr double kSide = 0.005;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-gap * kSide / 2, gap * kSide / 2);
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("floor", Body::Kind::Fixed, {0.2, 0.2, 0.01}, {0, 0, -0.005}, {4, 4, 1})};
  for (int i = 0; i < n * n * n; ++i) {
    const auto at = [&](int k) { return (1 + gap) * kSide * (k + 0.5) + jitter(random); };
    Body cube = box_body("cube " + std::to_string(i), Body::Kind::Rigid, Vec3::Constant(kSide),
                         {at(i % n), at(i / n % n), at(i / n / n)});
    cube.density = 1000;
    s.bodies.push_back(cube);
  }
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

TEST(NearContacts, AreThosePairsWhoseBoxesOverlap) {
  std::mt19937 random(4);
  std::size_t total = 0;
  for (int k = 0; k < 100; ++k) {
    const Rules rules = random_rules(random);
    const ContactPairs pairs(rules.named, rules.members, telling_makers());
    std::vector<collision::Aabb> boxes(rules.members.size());
    std::uniform_real_distribution<double> place(0, 1.5);
    for (collision::Aabb& box : boxes) {
      box.include({place(random), place(random), place(random)});
      box.include(box.min + Vec3::Ones());
    }
    std::vector<ContactId> expected;
    for (const ContactId contact : pairs.all()) {
      const ContactModel made = pairs[contact];
      if (made.a == made.b ||
          overlap(boxes[static_cast<std::size_t>(made.a)], boxes[static_cast<std::size_t>(made.b)]))
        expected.push_back(contact);
    }
    EXPECT_EQ(NearContacts().find(pairs, boxes), expected);
    total += expected.size();
  }
  EXPECT_GT(total, 200U);
}

TEST(NearContacts, OfAHeapAreSoManyForEachBodyHoweverManyThereAre) {
  std::vector<double> tests, near;  // by bodies
  for (const int n : {3, 6, 9}) {
    const Scenario scenario = heap(n, 0.02);
    const Model model = build_model(scenario);
    const double bodies = std::pow(n, 3);
    EXPECT_EQ(model.contacts.size(), static_cast<std::int64_t>(bodies * (bodies + 1) / 2));
    ContactSearch search(model, step_settings(scenario));
    Configuration start;
    const Eigen::VectorXd y = initial_state(model);
    read_state(model, y.data(), 0, start);
    search.find(start, model.detection_margin);
    tests.push_back(static_cast<double>(search.counts().evaluations[Term::BoxTest]) / bodies);
    near.push_back(static_cast<double>(search.counts().evaluations[Term::PairQuery]) / bodies);
  }
  // Of 27, 216 and 729 cubes; with all pairs it would be 14, 108 and 365.
  EXPECT_GT(near[0], 1);
  EXPECT_LT(near[2], 13);  // of 26 neighbours each half
  // More of them lie inside, and the tree is deeper; of all pairs it would be 3.4 times as many.
  EXPECT_LT(tests[2], 2 * tests[1]);
  EXPECT_LT(tests[2], 100);
}

}  // namespace articular::sim::contact_pairs_test
