"""What a click in a plan pane does: one class per tool, pure logic in plan coordinates. No Qt."""
