// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>
#include <tbb/task_group.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/parallel_sort.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

bool go_on(std::string_view /*stage*/, double /*share*/) { return true; }

/// Says no when it is asked for the third time.
Progress stop_at_third(int& asked) {
  return [&asked](std::string_view, double) { return ++asked < 3; };
}

TEST(WithProgress, CancelsLoopsThatWouldNeverEnd) {
  int asked = 0;
  EXPECT_THROW(with_progress(stop_at_third(asked), "loop",
                             [](const Progress&) {
                               for (;;) parallel_for_each_index(64, [](std::size_t) {});
                             }),
               Cancelled);
  EXPECT_EQ(asked, 3);
}

TEST(WithProgress, CancelsLoopsWithinLoops) {
  int asked = 0;
  EXPECT_THROW(with_progress(stop_at_third(asked), "loop",
                             [](const Progress&) {
                               parallel_for_each_index(4, [](std::size_t) {
                                 for (;;) parallel_for_each_index(64, [](std::size_t) {});
                               });
                             }),
               Cancelled);
}

TEST(WithProgress, CancelsSortingThatWouldNeverEnd) {
  int asked = 0;
  EXPECT_THROW(with_progress(stop_at_third(asked), "sort",
                             [](const Progress&) {
                               std::vector<int> values(1000);
                               for (;;) detail::parallel_sort(values.begin(), values.end());
                             }),
               Cancelled);
}

TEST(WithProgress, CancelsWorkThatAsksItself) {
  std::vector<std::string> stages;
  const Progress stop_at_second = [&](std::string_view stage, double share) {
    stages.push_back(std::string(stage) + " " + std::to_string(share));
    return stage != "second";
  };
  EXPECT_THROW(with_progress(stop_at_second, "none",
                             [](const Progress& report) {
                               ASSERT_TRUE(report("first", 0.25));
                               if (!report("second", 0.5)) throw Cancelled();
                             }),
               Cancelled);
  std::erase(stages, "none 0.000000");  // where the thread took its time
  ASSERT_GE(stages.size(), 2u);
  EXPECT_EQ(stages.front(), "first 0.250000");
  EXPECT_EQ(stages.back(), "second 0.500000");
}

TEST(WithProgress, GivesTheResultAndWhatTheWorkThrows) {
  EXPECT_EQ(with_progress(go_on, "", [](const Progress&) { return std::string("made"); }), "made");
  EXPECT_THROW(
      with_progress(go_on, "", [](const Progress&) { throw InputError("map", "is bad", "mend"); }),
      InputError);
  const auto in_a_loop = [](const Progress&) {
    parallel_for_each_index(64, [](std::size_t i) {
      if (i == 33) throw InputError("map", "is bad", "mend it");
    });
  };
  EXPECT_THROW(with_progress(go_on, "", in_a_loop), InputError);
}

TEST(WithProgress, GivesWhatProgressThrowsOnceTheWorkHasEnded) {
  std::atomic<bool> has_ended{false};
  const Progress angry = [](std::string_view, double) -> bool { throw std::logic_error("no"); };
  EXPECT_THROW(with_progress(angry, "loop",
                             [&](const Progress&) {
                               try {
                                 for (;;) parallel_for_each_index(64, [](std::size_t) {});
                               } catch (const Cancelled&) {
                                 has_ended = true;
                                 throw;
                               }
                             }),
               std::logic_error);
  EXPECT_TRUE(has_ended);
}

TEST(WithProgress, AsksInTheCallingThreadAndWorksWithAsManyThreads) {
  const std::thread::id caller = std::this_thread::get_id();
  int asked = 0;
  const Progress progress = [&](std::string_view, double) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    ++asked;
    return true;
  };
  const int threads = with_threads(1, [&] {
    return with_progress(progress, "", [&](const Progress& report) {
      EXPECT_NE(std::this_thread::get_id(), caller);
      report("stage", 0.5);
      std::atomic<int> inside{0}, most{0};
      parallel_for_each_index(1000, [&](std::size_t) {
        const int now = ++inside;
        if (now > most) most = now;
        --inside;
      });
      return most.load();
    });
  });
  EXPECT_EQ(threads, 1);
  EXPECT_GE(asked, 1);
}

TEST(WithProgress, IsAPlainCallForThoseWhoDoNotAsk) {
  const std::thread::id caller = std::this_thread::get_id();
  with_progress({}, "", [&](const Progress& report) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_FALSE(report);
  });
}

TEST(Parallel, ThrowsWhereTheCallersTaskGroupIsCancelledAndBodiesNeverRan) {
  tbb::task_group_context context;
  bool has_thrown = false;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, 1),
      [&](const tbb::blocked_range<int>&) {
        context.cancel_group_execution();
        try {
          parallel_for_each_index(1000, [](std::size_t) {});
        } catch (const Cancelled&) {
          has_thrown = true;
        }
      },
      context);
  EXPECT_TRUE(has_thrown);
}

}  // namespace
}  // namespace ridgeway
