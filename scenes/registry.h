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

// A family of named, interchangeable functions with one signature: the stages of the pipeline, the sensor models.
// Tag is a struct with `static constexpr const char*` members name and default_variant. A variant is one .cpp file that
// registers itself with
//   const Fuse::Variant variant{"tsdf", tsdf};
// where tsdf is Out(const In&..., const Params&) or Out(const In&..., const Params&, Seed).
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

   private:
    template <class Params, class Function>
    void add(const char* name, Function function) {
      const std::string where = std::string(Tag::name) + "." + name;
      Entry entry;
      entry.name = name;
      entry.fields = list_fields(Params{});
      entry.run = [where, function](const In&... in, const FieldValues& values, Seed seed) {
        return function(in..., assign_fields<Params>(where, values), seed);
      };
      entry.complete = [where](const FieldValues& values) {
        FieldValues all;
        for (const auto& field : list_fields(assign_fields<Params>(where, values))) all[field.name] = field.value;
        return all;
      };
      if (!entries().emplace(name, entry).second) throw std::logic_error(where + " is registered twice");
    }
  };

  static std::string name() { return Tag::name; }
  static std::string default_variant() { return Tag::default_variant; }

  static std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const auto& [key, entry] : entries()) result.push_back(key);
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
