#include "sim/model/contact_pairs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "sim/model/model.hpp"

namespace articular::sim {

Eigen::VectorXd stiffness_at_groups(const ContactModel& contact, const Collider& nonmortar,
                                    bool soft) {
  if (!contact.averaged)
    return Eigen::VectorXd::Constant(std::ssize(nonmortar.group_node),
                                     contact.share * contact.mean_stiffness);
  const Eigen::ArrayXd compliance =
      contact.softening * nonmortar.compliance(nonmortar.group_node).array();
  const double factor = soft ? contact.soft_factor : contact.factor;
  return (contact.share / ((compliance + contact.opposite) / factor + contact.layers)).matrix();
}

LayersInSeries layers_of(const ContactModel& contact, double stiffness) {
  LayersInSeries series{1 / stiffness, contact.logarithmic};
  for (const LogarithmicLayer& layer : series.layer) series.linear -= layer.compliance();
  series.linear = std::max(0.0, series.linear);  // by round-off
  return series;
}

ContactPairs::ContactPairs(std::vector<Named> named, std::vector<Member> members, Makers makers)
    : named_(std::move(named)), members_(std::move(members)), makers_(std::move(makers)) {
  for (std::size_t i = 0; i < named_.size(); ++i)
    id_of_named_[std::minmax(named_[i].a, named_[i].b)] = static_cast<ContactId>(i);
  count();
}

/// Of a pair that may be named besides.
std::optional<std::size_t> ContactPairs::bit_of(int a, int b) const {
  const Member &p = members_[static_cast<std::size_t>(a)],
               &q = members_[static_cast<std::size_t>(b)];
  const std::uint64_t fits = (p.first & q.second) | (p.second & q.first);
  if (a == b || fits == 0 || (p.is_fixed && q.is_fixed)) return std::nullopt;
  return static_cast<std::size_t>(std::countr_zero(fits));
}

/// How many pairs come before those whose lower body it is.
ContactId ContactPairs::pairs_before(ContactId body) const {
  return body * num_bodies() - body * (body + 1) / 2;
}

ContactId ContactPairs::id_of(const Bodies& bodies) const {
  return std::ssize(named_) + pairs_before(bodies.first) + bodies.second - bodies.first - 1;
}

ContactPairs::Bodies ContactPairs::members_of(ContactId contact) const {
  const ContactId pair = contact - std::ssize(named_);
  int low = 0, high = num_bodies() - 1;  // the lower body is one of [low, high)
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (pairs_before(middle) <= pair ? low : high) = middle;
  }
  return {low, static_cast<int>(pair - pairs_before(low)) + low + 1};
}

std::optional<ContactId> ContactPairs::between(int a, int b) const {
  const Bodies bodies = std::minmax(a, b);
  if (empty()) return std::nullopt;
  if (left_out_ == bodies) return std::nullopt;
  if (const auto known = id_of_named_.find(bodies); known != id_of_named_.end())
    return known->second;
  if (!bit_of(a, b)) return std::nullopt;
  return id_of(bodies);
}

ContactModel ContactPairs::operator[](ContactId contact) const {
  if (contact < std::ssize(named_))
    return makers_.of_named(named_[static_cast<std::size_t>(contact)]);
  const auto [a, b] = members_of(contact);
  return makers_.of_members(a, b, bit_of(a, b).value());
}

/// Bodies that are members of the same sets are of one class, in which few pairs stand for all.
void ContactPairs::count() {
  size_ = 0;
  selves_.clear();
  kinds_.clear();
  touches_.assign(members_.size(), 0);
  const auto touch = [&](int body) { touches_[static_cast<std::size_t>(body)] = 1; };
  for (const auto& [bodies, id] : id_of_named_) {
    if (left_out_ == bodies) continue;
    ++size_;
    if (bodies.first != bodies.second && bit_of(bodies.first, bodies.second)) --size_;
    touch(bodies.first);
    touch(bodies.second);
  }
  for (std::size_t i = 0; i < named_.size(); ++i) {
    if (left_out_ == Bodies(std::minmax(named_[i].a, named_[i].b))) continue;
    kinds_.push_back(static_cast<ContactId>(i));
    if (named_[i].a == named_[i].b) selves_.push_back(static_cast<ContactId>(i));
  }
  std::map<std::tuple<std::uint64_t, std::uint64_t, bool, bool>, std::vector<int>> classes;
  for (int body = 0; body < num_bodies(); ++body) {
    const Member& m = members_[static_cast<std::size_t>(body)];
    if (m.first != 0 || m.second != 0)
      classes[{m.first, m.second, m.is_fixed, m.is_tissue}].push_back(body);
  }
  const auto smaller = [&](int a, int b) {
    return std::pair(members_[static_cast<std::size_t>(a)].size, a) <
           std::pair(members_[static_cast<std::size_t>(b)].size, b);
  };
  for (auto& [sets, bodies] : classes)
    std::partial_sort(bodies.begin(),
                      bodies.begin() + std::min<std::ptrdiff_t>(2, std::ssize(bodies)),
                      bodies.end(), smaller);
  for (auto p = classes.begin(); p != classes.end(); ++p)
    for (auto q = p; q != classes.end(); ++q) {
      const bool is_same = p == q;
      if (is_same && p->second.size() < 2) continue;
      const int a = p->second[0], b = q->second[is_same ? 1 : 0];
      if (!bit_of(a, b)) continue;
      const auto n = std::ssize(p->second), m = std::ssize(q->second);
      size_ += is_same ? n * (n - 1) / 2 : n * m;
      kinds_.push_back(id_of(std::minmax(a, b)));
      for (const int body : p->second) touch(body);
      for (const int body : q->second) touch(body);
    }
  if (left_out_ && bit_of(left_out_->first, left_out_->second)) --size_;
}

std::vector<ContactId> ContactPairs::all() const {
  std::vector<ContactId> found = selves_;
  for (int a = 0; a < num_bodies(); ++a)
    for (int b = a + 1; b < num_bodies(); ++b)
      if (const auto contact = between(a, b)) found.push_back(*contact);
  std::sort(found.begin(), found.end());
  return found;
}

ContactPairs ContactPairs::only(ContactId contact) const {
  const ContactModel made = (*this)[contact];
  Makers makers;
  makers.of_named = [made](const Named&) { return made; };
  return {{Named{made.a, made.b, 0}}, std::vector<Member>(members_.size()), std::move(makers)};
}

ContactPairs ContactPairs::without(ContactId contact) const {
  ContactPairs rest = *this;
  const ContactModel made = (*this)[contact];
  rest.left_out_ = std::minmax(made.a, made.b);
  rest.count();
  return rest;
}

void ContactPairs::change(std::function<void(ContactModel&)> by) {
  const auto changed = [by = std::move(by)](ContactModel contact) {
    by(contact);
    return contact;
  };
  makers_ = {[=, make = makers_.of_named](const Named& named) { return changed(make(named)); },
             [=, make = makers_.of_members](int a, int b, std::size_t bit) {
               return changed(make(a, b, bit));
             }};
}

}  // namespace articular::sim
