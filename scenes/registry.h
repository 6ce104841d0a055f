#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "scenes/error.h"
#include "scenes/fields.h"

namespace dressform {

using Seed = std::uint64_t;
struct Picks;

// A family of named, interchangeable functions with one signature: the stages of the pipeline, the sensor models.
// Tag is a struct with `static constexpr const char*` members name and default_variant. A variant is one .cpp file that
// registers itself with
//   const Fuse::Variant variant{"tsdf", tsdf};
// where tsdf is Out(const In&..., const Params&) or Out(const In&..., const Params&, Seed). A variant that takes what a
// person picked (scenes/picks.h) is Out(const In&..., const Params&, const Picks&[, Seed]) and says which picks:
//   const Open::Variant variant{"thesis_picked", thesis_picked, {"rim_*"}};
template <class Tag, class Signature>
class Registry;

template <class Tag, class Out, class... In>
class Registry<Tag, Out(const In&...)> {
 public:
  using Output = Out;
  struct Entry {
    std::string name;
    std::vector<FieldInfo> fields;  // with defaults
    // Checks the values against the variant's fields (InputError), then runs it.
    std::function<Out(const In&..., const FieldValues&, Seed)> run;
    // Names of the picks without which it can't work ("*": any ending); empty: it works by itself. Then it is run by
    // run_with_picks, and `run` throws InputError.
    std::vector<std::string> picks;
    std::function<Out(const In&..., const FieldValues&, const Picks&, Seed)> run_with_picks;
    // All parameters: the defaults overridden by `values`, in their own types. Throws InputError where a value is
    // unknown, of the wrong type or out of range.
    std::function<FieldValues(const FieldValues&)> complete;
  };

  class Variant {
   public:
    template <class Params>
    Variant(const char* name, Out (*function)(const In&..., const Params&)) {
      add<Params>(name, [function](const In&... in, const Params& params, Seed) { return function(in..., params); });
    }
    template <class Params>
    Variant(const char* name, Out (*function)(const In&..., const Params&, Seed)) {
      add<Params>(name, function);
    }
    template <class Params>
    Variant(const char* name, Out (*function)(const In&..., const Params&, const Picks&),
            std::vector<std::string> picks) {
      add_picked<Params>(
          name,
          [function](const In&... in, const Params& params, const Picks& picked, Seed) {
            return function(in..., params, picked);
          },
          std::move(picks));
    }
    template <class Params>
    Variant(const char* name, Out (*function)(const In&..., const Params&, const Picks&, Seed),
            std::vector<std::string> picks) {
      add_picked<Params>(name, function, std::move(picks));
    }

   private:
    template <class Params, class Function>
    void add(const char* name, Function function) {
      const std::string where = std::string(Tag::name) + "." + name;
      Entry entry = described<Params>(name);
      entry.run = [where, function](const In&... in, const FieldValues& values, Seed seed) {
        return function(in..., assign_fields<Params>(where, values), seed);
      };
      keep(entry);
    }

    template <class Params, class Function>
    void add_picked(const char* name, Function function, std::vector<std::string> picks) {
      const std::string where = std::string(Tag::name) + "." + name;
      Entry entry = described<Params>(name);
      entry.picks = std::move(picks);
      entry.run = [where](const In&..., const FieldValues&, Seed) -> Out {
        throw InputError("variant " + where, "found no picks; expected what a person picked (scenes/README.md, picks)");
      };
      entry.run_with_picks = [where, function](const In&... in, const FieldValues& values, const Picks& picked,
                                               Seed seed) {
        return function(in..., assign_fields<Params>(where, values), picked, seed);
      };
      keep(entry);
    }

    template <class Params>
    static Entry described(const char* name) {
      const std::string where = std::string(Tag::name) + "." + name;
      Entry entry;
      entry.name = name;
      entry.fields = list_fields(Params{});
      entry.complete = [where](const FieldValues& values) {
        FieldValues all;
        for (const auto& field : list_fields(assign_fields<Params>(where, values))) all[field.name] = field.value;
        return all;
      };
      return entry;
    }

    static void keep(const Entry& entry) {
      if (!entries().emplace(entry.name, entry).second)
        throw std::logic_error(std::string(Tag::name) + "." + entry.name + " is registered twice");
    }
  };

  static std::string name() { return Tag::name; }
  static std::string default_variant() { return Tag::default_variant; }

  static std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const auto& [key, entry] : entries()) result.push_back(key);
    return result;
  }

  // Those that need nothing picked by hand.
  static std::vector<std::string> automatic_names() {
    std::vector<std::string> result;
    for (const auto& [key, entry] : entries())
      if (entry.picks.empty()) result.push_back(key);
    return result;
  }

  // Throws InputError that lists the registered names.
  static const Entry& at(const std::string& name) {
    const auto found = entries().find(name);
    if (found != entries().end()) return found->second;
    std::string known;
    for (const auto& each : names()) known += (known.empty() ? "" : ", ") + each;
    throw InputError(std::string("variant of ") + Tag::name, "found \"" + name + "\"; expected one of " + known);
  }

 private:
  static std::map<std::string, Entry>& entries() {
    static std::map<std::string, Entry> map;
    return map;
  }
};

}  // namespace dressform
