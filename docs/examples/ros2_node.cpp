// A ROS 2 lifecycle node around a generated component: designs/rescue, drive_circle.
// Not compiled by vicode's tests, which run without ROS. For another project, change the three places marked HERE.
#include <chrono>
#include <memory>

#include <geometry_msgs/msg/twist.hpp>
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include "rescue/components.hpp"

using rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface;
using CallbackReturn = LifecycleNodeInterface::CallbackReturn;

// HERE: inputs are what subscriptions stored last, commands are what the timer publishes.
class Robot final : public rescue::World {
public:
    double amount_turned() override { return turned_deg; }
    double laser_max() override { return 0.0; }
    double laser_min_wnw() override { return 0.0; }
    double laser_min_nw() override { return 0.0; }
    double laser_min_nnw() override { return 0.0; }
    double laser_min_n() override { return 0.0; }
    double laser_min_nne() override { return 0.0; }
    double laser_min_ne() override { return 0.0; }
    double laser_min_ene() override { return 0.0; }
    void differential_drive(double speed, double turning_speed) override {
        command.linear.x = speed;
        command.angular.z = bica::radians(turning_speed);
    }
    void wait(double) override {}

    double turned_deg = 0.0;
    geometry_msgs::msg::Twist command;
};

class BehaviorNode final : public rclcpp_lifecycle::LifecycleNode {
public:
    BehaviorNode() : LifecycleNode("behavior"), components_(root_, robot_) {
        root_.on_error = [](const bica::Component& component, const char* what) {
            RCLCPP_ERROR(rclcpp::get_logger("behavior"), "%s, %s: %s", component.name(), component.state_name(), what);
        };
    }

    CallbackReturn on_configure(const rclcpp_lifecycle::State&) override {
        // HERE: the topics.
        publisher_ = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 1);
        subscription_ = create_subscription<nav_msgs::msg::Odometry>(
            "odom", rclcpp::SensorDataQoS(), [this](const nav_msgs::msg::Odometry& message) { turn(message); });
        return CallbackReturn::SUCCESS;
    }

    CallbackReturn on_activate(const rclcpp_lifecycle::State& state) override {
        LifecycleNode::on_activate(state);
        timer_ = create_wall_timer(std::chrono::milliseconds(20), [this] { tick(); });
        return CallbackReturn::SUCCESS;
    }

    CallbackReturn on_deactivate(const rclcpp_lifecycle::State& state) override {
        timer_.reset();
        robot_.command = geometry_msgs::msg::Twist();
        publisher_->publish(robot_.command);
        return LifecycleNode::on_deactivate(state);
    }

private:
    void turn(const nav_msgs::msg::Odometry& message) {
        robot_.turned_deg += bica::abs(bica::degrees(message.twist.twist.angular.z)) * 0.02;  // at 50 Hz
    }

    void tick() {
        // HERE: the root component. The time of ROS may be simulated.
        root_.step(components_.drive_circle, now().nanoseconds());
        publisher_->publish(robot_.command);
    }

    bica::Root root_;
    Robot robot_;
    rescue::Components components_;
    rclcpp_lifecycle::LifecyclePublisher<geometry_msgs::msg::Twist>::SharedPtr publisher_;
    rclcpp::Subscription<nav_msgs::msg::Odometry>::SharedPtr subscription_;
    rclcpp::TimerBase::SharedPtr timer_;
};

int main(int count, char** words) {
    rclcpp::init(count, words);
    const auto node = std::make_shared<BehaviorNode>();
    rclcpp::spin(node->get_node_base_interface());
    rclcpp::shutdown();
    return 0;
}
